// SPDX-License-Identifier: MIT
// measure_process.hpp: measures stored traces in a process of its own, so that a metric that crashes, hangs or eats all
// memory takes nothing with it but its values for that trial.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/evaluate/evaluation.hpp"
#include "host/workers/messages.hpp"

namespace dmrp::host {

struct StoredTrial {
  std::uint64_t id = 0;
  std::uint64_t seed = 0;
  std::filesystem::path trace;
};

// What comes of it, in the order of the trials and, for each, of the metrics.
struct MeasureSinks {
  std::function<void(const StoredTrial&, const MetricResult&)> result;
  std::function<void(const StoredTrial&, const std::string& text)> failure;  // of a metric or a trace, in one line
};

// Loads the libraries, makes the metrics and measures every trial as it was measured live. The metrics' warnings go to
// standard error. Throws std::runtime_error where the libraries cannot be loaded, and std::system_error.
void measure_stored(const Evaluation& evaluation, const std::vector<StoredTrial>& trials, const MeasureSinks& sinks);

}  // namespace dmrp::host
