// SPDX-License-Identifier: MIT
#include "metrics/paper/sto.hpp"

#include <stdexcept>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/planned_overlap.hpp"
#include "metrics/measure/thresholds.hpp"

namespace dmrp::metrics {

Descriptor Sto::describe() {
  return describe_metric("dmrp.metric.sto", "Spatio-temporal overlap")
      .summary("share of planned waypoints near another robot's waypoint of about the same step")
      .source("Hu et al., DMRP-Bench, ICRA 2026: STO")
      .value("sto", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "share of the robot's waypoints in the first plan (one a step, waits kept, until its goal) within "
             "distance_m of another robot's waypoint within window steps; undefined if planning failed")
      .value("sto_by_distance", "1", Direction::lower_is_better, Subjects::system,
             "the system's sto over distances_m; undefined if planning failed")
      .curve()
      .value("sto_cell_size", "m", Direction::none, Subjects::system,
             "the size of the planning grid's cells; undefined if planning failed");
}

void Sto::finish(const TrialEnd&, MetricSink& sink) {
  if (has_paths() && first_plan_->step_duration_ns <= 0)
    throw std::invalid_argument("STO needs a plan with a step duration above 0");
  const auto all = has_paths() ? resample_all(*first_plan_, first_plan_->step_duration_ns) : std::vector<Steps>();
  const auto steps = static_cast<std::size_t>(*window);
  give_mean(sink, "sto", overlapping_shares(all, distance_m, steps));
  give_curve(sink, "sto_by_distance", distances_m,
             [&](double threshold_m) { return mean_of_defined(overlapping_shares(all, threshold_m, steps)); });
  sink.system("sto_cell_size", has_paths() ? world().planning_grid().resolution_m : undefined);
}

}  // namespace dmrp::metrics
