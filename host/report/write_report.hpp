// SPDX-License-Identifier: MIT
// write_report.hpp: RUN_DIR/report.html, from what the run left behind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dmrp::host {

// `replayed`: ids of trials whose replay goes in whatever they are like.
// Throws InputError where `run_directory` is none, where nothing was measured yet, or for a trial that is not there; std::exceptions where a file is
// damaged or cannot be written. An old report stays until the new one is whole.
void write_report(const std::filesystem::path& run_directory, const std::vector<std::uint64_t>& replayed = {});

}  // namespace dmrp::host
