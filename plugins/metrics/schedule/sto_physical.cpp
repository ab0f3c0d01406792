// SPDX-License-Identifier: MIT
#include "metrics/schedule/sto_physical.hpp"

#include <cmath>
#include <vector>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/planned_overlap.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::int64_t period_ns = 250'000'000;

}  // namespace

Descriptor StoPhysical::describe() {
  return describe_metric("dmrp.metric.sto_physical", "Spatio-temporal overlap in metres and seconds")
      .summary("share of planned positions near another robot's of about the same time")
      .source("Hu et al., DMRP-Bench, ICRA 2026: STO, measured in time instead of waypoints")
      .value("sto_physical", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "of the robot's planned positions every 0.25 s until it rests at its goal, the share within distance_m of "
             "another robot's at most window_s earlier or later; undefined if planning failed");
}

void StoPhysical::finish(const TrialEnd&, MetricSink& sink) {
  const auto all = has_paths() ? resample_all(*first_plan_, period_ns) : std::vector<Steps>();
  constexpr double rounding = 1e-9;  // 3.6 s is a whole number of tenths, not of binary fractions
  const double window = std::floor(*window_s * 1e9 / static_cast<double>(period_ns) + rounding);
  give_mean(sink, "sto_physical", overlapping_shares(all, distance_m, static_cast<std::size_t>(window)));
}

}  // namespace dmrp::metrics
