// SPDX-License-Identifier: MIT
// report_values.hpp: the value of a metric for a trial, with substitutes for undefined values.
#pragma once

#include <cstddef>
#include <optional>

#include "host/report/data/report_frame.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// Rules for substitutes; none by default.
struct CountedValue {
  std::size_t metric = 0;        // index
  bool counts_failures = false;  // a trial that ended in a fault counts as 0 (SummaryLayout)
  bool censored = false;         // a time: an undefined value counts as the time limit
  bool successes_only = false;   // excludes other trials
};

// The time limit of a trial's scenario; none if the manifest lacks it.
std::optional<double> time_limit_s(const ExperimentFacts& facts, const CombinationLabels& combination);

// The system's value of that trial; none for a skipped trial.
std::optional<double> counted_value(const ReportFrame& frame, const ExperimentFacts& facts, const CountedValue& rule,
                                    std::size_t trial);

}  // namespace dmrp::host
