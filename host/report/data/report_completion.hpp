// SPDX-License-Identifier: MIT
// report_completion.hpp: arrival times, including robots that never arrive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/statistics/kaplan_meier.hpp"
#include "core/statistics/mean_of_tasks.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// The robots of all trials of a combination. A robot that has not arrived at the end of its trial (time limit, deadlock
// or fault) is censored at the time limit, not at the end: a deadlock does not mean that it would have arrived soon.
struct ArrivalTimes {
  std::size_t combination;
  std::uint32_t robots;
  double horizon_s;  // the time limit
  core::MeanOfTasks restricted_mean_s;
  double arrived_share;
  std::vector<core::SurvivalStep> not_arrived;  // share of robots that have not arrived
};

// For each combination with robots; empty if the metric of the layout was not measured.
std::vector<ArrivalTimes> arrival_times(const ReportFrame& frame, const ExperimentFacts& facts,
                                        const ReportLayout& layout);

}  // namespace dmrp::host
