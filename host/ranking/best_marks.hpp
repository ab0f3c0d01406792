// SPDX-License-Identifier: MIT
// best_marks.hpp: which means of a table deserve to be marked as the best of their column.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/findings/findings.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

struct BestMark {
  CombinationLabels labels;  // of the row: those that it does not have are empty
  std::string metric;

  bool operator==(const BestMark&) const = default;
};

// What a row of a table is.
enum class Contestants { planners_and_controllers, planners };

// One mark at most for each metric among the rows of a scenario, number of robots and pedestrian model: the row that
// alone may be the best, with 95 % confidence (core::best_set), each metric by itself. A robot that fails drives less:
// metrics of driving are marked only where all rows have the same success. Measured times of the machine are not marked:
// the same code takes longer in one trial than in another. Rows by planner are compared over all pedestrian models.
std::vector<BestMark> best_marks(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                                 std::span<const TrialRecord> trials, Contestants contestants);

}  // namespace dmrp::host
