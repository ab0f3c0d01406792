// SPDX-License-Identifier: MIT
// sto.hpp: spatio-temporal overlap: the share of planned waypoints near another robot's at about the same time.
#pragma once

#include <stdexcept>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/planned_overlap.hpp"

namespace dmrp::metrics {

class Sto final : public FirstPlanMetric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.sto", "Spatio-temporal overlap")
        .summary("share of planned waypoints near another robot's waypoint of about the same step")
        .source("Hu et al., DMRP-Bench, ICRA 2026: STO")
        .value("sto", "1", lower_is_better, system_and_robots,
               "share of the robot's waypoints in the first plan (one a step, waits kept, until its goal) within "
               "distance_m of another robot's waypoint within window steps; undefined if planning failed",
               share_range)
        .value("sto_by_distance", "1", lower_is_better, Subjects::system,
               "the system's sto over distances_m; undefined if planning failed", share_range)
        .curve()
        .value("sto_cell_size", "m", Direction::none, Subjects::system,
               "the size of the planning grid's cells; undefined if planning failed", never_negative);
  }

  Param<double> distance_m =
      param("distance_m", 0.5).unit("m").range(0.0, 100.0).doc("D: waypoints at most this far apart overlap");
  Param<std::int64_t> window =
      param("window", 2).unit("1").range(0, 1000).doc("k: waypoints at most this many steps apart overlap");

  Param<std::vector<double>> distances_m =
      param("distances_m", std::vector<double>{0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0})
          .unit("m")
          .range(0.0, 100.0)
          .doc("values of D for the curve sto_by_distance");

  void finish(const TrialEnd&, MetricSink& sink) override {
    if (has_paths() && first_plan_->step_duration_ns <= 0)
      throw std::invalid_argument("STO needs a plan with a step duration above 0");
    const auto all = has_paths() ? resample_all(first_plan_, first_plan_->step_duration_ns) : std::vector<Steps>();
    const auto steps = static_cast<std::size_t>(*window);
    const auto shares = [&](double threshold_m) {
      return overlapping_shares(
          all, [=](std::size_t, std::size_t) { return threshold_m; }, threshold_m, steps);
    };
    give(sink, "sto", &mean_of_defined, shares(distance_m));
    give_curve(sink, "sto_by_distance", distances_m,
               [&](double threshold_m) { return mean_of_defined(shares(threshold_m)); });
    sink.system("sto_cell_size", has_paths() ? world().planning_grid().resolution_m : undefined);
  }
};

}  // namespace dmrp::metrics
