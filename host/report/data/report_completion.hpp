// SPDX-License-Identifier: MIT
// report_completion.hpp: when robots arrive, those that never do included.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/statistics/kaplan_meier.hpp"
#include "host/report/data/report_frame.hpp"
#include "host/report/data/report_layout.hpp"
#include "host/results/manifest.hpp"

namespace dmrp::host {

// Robots of all trials of a combination. Who had not arrived when the trial ended, by the time limit, a deadlock or a
// fault, counts as watched until the time limit: a deadlock is no reason to think that the robot would soon have been
// there.
struct ArrivalTimes {
  std::size_t combination;
  std::uint32_t robots;
  double horizon_s;  // the time limit
  double restricted_mean_s;
  core::Interval interval;  // 95 %, over seeds
  double arrived_share;
  std::vector<core::SurvivalStep> not_arrived;  // share of robots that is still under way
};

// Combinations with robots, where the layout names a metric that was measured.
std::vector<ArrivalTimes> arrival_times(const ReportFrame& frame, const ExperimentFacts& facts,
                                        const ReportLayout& layout);

}  // namespace dmrp::host
