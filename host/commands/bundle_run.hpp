// SPDX-License-Identifier: MIT
// bundle_run.hpp: a run as a folder that repeats it elsewhere.
#pragma once

#include <filesystem>

namespace dmrp::host {

// Writes the folder `out`. No other process may work on the run directory `run`.
void bundle_run(const std::filesystem::path& run, const std::filesystem::path& out, bool with_plugins);

// Throws InputError if something is there.
void check_new_bundle(const std::filesystem::path& out);

}  // namespace dmrp::host
