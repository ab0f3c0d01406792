// SPDX-License-Identifier: MIT
// measure_stored.hpp: measures stored traces in guests: a metric that crashes, hangs or takes all memory loses its own values
// of that trial only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "host/results/trial_record.hpp"

namespace dmrp::host {

struct StoredTrial {
  std::uint64_t id = 0;
  std::uint64_t seed = 0;
  std::filesystem::path trace;
};

// Receive the results in the order of the trials and, for each trial, of the metrics.
struct MeasureSinks {
  std::function<void(const StoredTrial&, const MetricResult&)> result;
  std::function<void(const StoredTrial&, const std::string& text)> failure;  // of a metric or a trace; one line
};

// Loads the libraries, creates the metrics and measures every trial as during the run. The metrics' warnings go to
// standard error. Throws std::runtime_error if the libraries cannot be loaded, and MachineError.
void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks);

}  // namespace dmrp::host
