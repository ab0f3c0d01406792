// SPDX-License-Identifier: MIT
// write_report.hpp: writes RUN_DIR/report.html from the results of a run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace dmrp::host {

// `replayed`: ids of trials whose replays are embedded in any case. Replaces an existing report atomically. Throws
// InputError if `run_directory` is no run directory, has no finished trial, or lacks a trial of `replayed`; other
// std::exceptions if a file is damaged or cannot be written.
void write_report(const std::filesystem::path& run_directory, const std::vector<std::uint64_t>& replayed = {});

}  // namespace dmrp::host
