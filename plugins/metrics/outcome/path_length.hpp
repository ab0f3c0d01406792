// SPDX-License-Identifier: MIT
// path_length.hpp: driven length, planned length and planned turns.
#pragma once

#include <dmrp/toolkit/polyline.hpp>

#include "metrics/measure/driven_length.hpp"
#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class PathLength final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.path_length", "Path length")
        .summary("driven length, planned length, planned turns")
        .source("Hu et al., DMRP-Bench, ICRA 2026: total path length")
        .value("path_length", "m", lower_is_better, system_and_robots,
               "length driven: sum of |dp| over all samples; system: sum over robots; undefined if planning failed",
               never_negative)
        .value("planned_length", "m", lower_is_better, system_and_robots,
               "length of the first plan; system: sum over robots; undefined if planning failed", never_negative)
        .value("plan_turns", "1", lower_is_better, system_and_robots,
               "changes of direction between moves of the first plan; system: sum over robots; undefined if planning "
               "failed",
               never_negative);
  }

  void begin(const MetricTrial& trial) override {
    first_plan_ = trial.plan;
    driven_.begin(world().robots().size());
  }

  void observe(const Sample& sample) override { driven_.observe(sample); }

  void finish(const TrialEnd&, MetricSink& sink) override {
    std::vector<double> driven_m, planned_m, turns;
    for (std::size_t robot = 0; first_plan_ && robot < world().robots().size(); ++robot) {
      const Path path = first_plan_.path(robot);
      driven_m.push_back(driven_.of_robot(robot));
      planned_m.push_back(toolkit::length(path));
      turns.push_back(count_turns(path));
    }
    give(sink, "path_length", &sum_of_defined, driven_m);
    give(sink, "planned_length", &sum_of_defined, planned_m);
    give(sink, "plan_turns", &sum_of_defined, turns);
  }

 private:
  // Two moves are collinear if the sine of their angle is below this: waypoints are rounded.
  static constexpr double collinear_sine = 1e-6;

  static bool turns(Vec2 from, Vec2 to) {
    const double product = toolkit::norm(from) * toolkit::norm(to);
    return toolkit::dot(from, to) < 0.0 || std::fabs(toolkit::cross(from, to)) > collinear_sine * product;
  }

  // Changes of direction between successive moves. Waits and the heading at the start are not moves.
  static int count_turns(const Path& path) {
    int count = 0;
    Vec2 direction = {0.0, 0.0};
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vec2 move = toolkit::position(path[i]) - toolkit::position(path[i - 1]);
      if (move == Vec2{0.0, 0.0}) continue;
      if (direction != Vec2{0.0, 0.0} && turns(direction, move)) ++count;
      direction = move;
    }
    return count;
  }

  Plan first_plan_;
  DrivenLength driven_;
};

}  // namespace dmrp::metrics
