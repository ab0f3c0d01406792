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
        .value(
            "sto_physical", "1", lower_is_better, system_and_robots,
            "of the robot's planned positions every 0.2 s until it rests at its goal, the share at which the circle "
            "around it comes within gap_m of another robot's at most window_s earlier or later; undefined if planning "
            "failed",
            share_range);
  }

  Param<double> gap_m =
      param("gap_m", 0.0).unit("m").range(0.0, 100.0).doc("circles with at most this gap between them overlap");
  Param<double> window_s = param("window_s", 0.2).unit("s").range(0.0, 1000.0).doc("greatest difference of times");

  void finish(const TrialEnd&, MetricSink& sink) override {
    const auto all = has_paths() ? resample_all(first_plan_, period_ns) : std::vector<Steps>();
    constexpr double rounding = 1e-9;  // 0.6 s is a whole number of fifths, not of binary fractions
    const double window = std::floor(*window_s * 1e9 / static_cast<double>(period_ns) + rounding);
    const auto radius_m = [&](std::size_t robot) { return world().robots()[robot].footprint->radius_m; };
    const auto distance_m = [&](std::size_t a, std::size_t b) { return radius_m(a) + radius_m(b) + *gap_m; };
    double widest_m = 0.0;
    for (std::size_t robot = 0; robot < all.size(); ++robot) widest_m = std::max(widest_m, distance_m(robot, robot));
    give(sink, "sto_physical", &mean_of_defined,
         overlapping_shares(all, distance_m, widest_m, static_cast<std::size_t>(window)));
  }

 private:
  static constexpr std::int64_t period_ns = 200'000'000;
};

}  // namespace dmrp::metrics
