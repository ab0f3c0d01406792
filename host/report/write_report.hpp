// SPDX-License-Identifier: MIT
// write_report.hpp: RUN_DIR/report.html, from what the run left behind.
#pragma once

#include <filesystem>

namespace dmrp::host {

// Throws InputError where `run_directory` is none, or where nothing was measured yet; std::exceptions where a file is
// damaged or cannot be written. An old report stays until the new one is whole.
void write_report(const std::filesystem::path& run_directory);

}  // namespace dmrp::host
