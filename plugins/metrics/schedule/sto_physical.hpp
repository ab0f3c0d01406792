// SPDX-License-Identifier: MIT
// sto_physical.hpp: spatio-temporal overlap of plans in metres and seconds, whatever their cells and steps.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/planned_overlap.hpp"

namespace dmrp::metrics {

class StoPhysical final : public FirstPlanMetric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.sto_physical", "Spatio-temporal overlap in metres and seconds")
        .summary("share of planned positions near another robot's of about the same time")
        .source("Hu et al., DMRP-Bench, ICRA 2026: STO, measured in time instead of waypoints")
        .value("sto_physical", "1", lower_is_better, system_and_robots,
               "of the robot's planned positions every 0.25 s until it rests at its goal, the share within distance_m "
               "of another robot's at most window_s earlier or later; undefined if planning failed",
               share_range);
  }

  Param<double> distance_m =
      param("distance_m", 0.5).unit("m").range(0.0, 100.0).doc("positions at most this far apart overlap");
  Param<double> window_s = param("window_s", 3.6).unit("s").range(0.0, 1000.0).doc("greatest difference of times");

  void finish(const TrialEnd&, MetricSink& sink) override {
    const auto all = has_paths() ? resample_all(first_plan_, period_ns) : std::vector<Steps>();
    constexpr double rounding = 1e-9;  // 3.6 s is a whole number of tenths, not of binary fractions
    const double window = std::floor(*window_s * 1e9 / static_cast<double>(period_ns) + rounding);
    give(sink, "sto_physical", &mean_of_defined, overlapping_shares(all, distance_m, static_cast<std::size_t>(window)));
  }

 private:
  static constexpr std::int64_t period_ns = 250'000'000;
};

}  // namespace dmrp::metrics
