// SPDX-License-Identifier: MIT
// run_directory.hpp: where a run leaves its files.
#pragma once

#include <filesystem>
#include <string>

namespace dmrp::host {

// The directory for a new run: `out` itself, which must be missing or empty; else runs/NAME, or runs/NAME-2, ... if
// taken. Nothing is made yet. Throws InputError.
std::filesystem::path choose_run_directory(const std::filesystem::path& out, const std::string& name);

// The directory of a run to go on with. Throws InputError.
std::filesystem::path existing_run_directory(const std::filesystem::path& out);

}  // namespace dmrp::host
