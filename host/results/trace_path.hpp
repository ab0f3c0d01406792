// SPDX-License-Identifier: MIT
// trace_path.hpp: which traces a run keeps, and where.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host/experiment/experiment.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

std::filesystem::path trace_path(const std::filesystem::path& run_directory, std::uint64_t trial);

// Whether the trace of this trial is kept.
bool keeps_trace(RecordTraces traces, const TrialRecord& trial);

// Whether the file is the one that the trial has left, as far as its row says.
bool is_trace_of(const TrialRecord& trial, const std::filesystem::path& file);

}  // namespace dmrp::host
