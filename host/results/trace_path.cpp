// SPDX-License-Identifier: MIT
#include "host/results/trace_path.hpp"

#include <fmt/format.h>

#include "host/files/sha256.hpp"

namespace dmrp::host {

std::filesystem::path trace_path(const std::filesystem::path& run_directory, std::uint64_t trial) {
  return run_directory / "traces" / fmt::format("trial_{:06}.mcap", trial);
}

bool keeps_trace(RecordTraces traces, const TrialRecord& trial) {
  if (traces == RecordTraces::all || traces == RecordTraces::none) return traces == RecordTraces::all;
  return trial.outcome != trial_outcome::succeeded || (traces == RecordTraces::some && trial.repetition == 0);
}

bool is_trace_of(const TrialRecord& trial, const std::filesystem::path& file) {
  return trial.trace_sha256.empty() || sha256_of_file(file) == trial.trace_sha256;
}

}  // namespace dmrp::host
