// SPDX-License-Identifier: MIT
// best_marks.hpp: which means of a table deserve to be marked as the best of their column.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/ranking/contest.hpp"
#include "host/results/summary_layout.hpp"
#include "host/results/system_values.hpp"

namespace dmrp::host {

struct BestMark {
  CombinationLabels labels;  // of the row: those that it does not have are empty
  std::string metric;

  bool operator==(const BestMark&) const = default;
};

// One mark at most for each metric among the rows of a scenario, number of robots and pedestrian model: the best mean,
// if paired differences tell it apart from every other row's (Holm, 5 %). A robot that fails drives less: metrics of
// driving are marked only where all rows have the same success. Measured times of the machine are not marked: the same
// code takes longer in one trial than in another. `contestants`: what a row is; rows by planner are
// compared over all pedestrian models.
std::vector<BestMark> best_marks(const SummaryLayout& layout, std::span<const MetricColumn> metrics,
                                 std::span<const TrialRecord> trials, Contestants contestants);

}  // namespace dmrp::host
