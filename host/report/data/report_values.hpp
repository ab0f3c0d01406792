// SPDX-License-Identifier: MIT
// report_values.hpp: what a trial counts with, where a metric that it does not define has a meaning all the same.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "host/report/data/report_frame.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// Rules for the metric: none by default.
struct CountedValue {
  std::size_t metric = 0;        // index
  bool counts_failures = false;  // a trial that ended in a fault counts with 0 (SummaryLayout)
  bool censored = false;         // a time: whoever has none counts with the time limit
  bool successes_only = false;   // other trials count with nothing
};

// The time limit of a trial's scenario; none where the manifest does not know it.
std::optional<double> time_limit_s(const ExperimentFacts& facts, const CombinationLabels& combination);

// The system's value of that trial; none for a skipped trial.
std::optional<double> counted_value(const ReportFrame& frame, const ExperimentFacts& facts, const CountedValue& rule,
                                    std::size_t trial);

}  // namespace dmrp::host
