// SPDX-License-Identifier: MIT
// mini_game.hpp: the measures of social mini-games that no other metric has.
#pragma once

#include <limits>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

// Sums up how one robot changes its velocity.
struct VelocityChange {
  CompensatedSum changes_m_s;
  Vec2 last;  // in the world's frame
  bool has_moved = false;

  double value() const { return has_moved ? changes_m_s.value() : undefined; }
};

class MiniGame final : public ActiveTimeMetric<VelocityChange> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.mini_game", "Social mini-game")
        .summary("how robots share a narrow place: waiting for each other, changes of velocity, flow")
        .source(
            "Chandra et al., Multi-Robot Navigation in Social Mini-Games, arXiv:2508.13459, 2025: makespan ratio, "
            "average "
            "change of velocity, flow rate; its path deviation is pfd, its Hausdorff distance pfd_max")
        .value("makespan_ratio", "1", lower_is_better, system_and_robots,
               "time of the robot's final arrival / that of the first robot to arrive; system: of the last, undefined "
               "unless all arrive",
               {1.0, std::numeric_limits<double>::infinity()})
        .value("velocity_change", "m/s", lower_is_better, system_and_robots,
               "sum over the steps of active time of |v - v of the step before|, v in the world's frame; undefined if "
               "planning failed",
               never_negative)
        .value("flow_rate", "1/m/s", higher_is_better, Subjects::system,
               "robots / (gap_width_m times the last arrival); 0 unless all arrive", never_negative);
  }

  void observe(const Sample& sample) override {
    ActiveTimeMetric::observe(sample);
    for (std::size_t robot = 0; robot < states_.size(); ++robot) states_[robot].last = velocity(sample.robots[robot]);
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    double first_s = undefined, last_s = undefined;
    bool all = !end.robots.empty();
    for (const RobotEnd& robot : end.robots) {
      all = all && robot.arrival_ns >= 0;
      if (robot.arrival_ns < 0) continue;
      first_s = std::fmin(first_s, in_seconds(robot.arrival_ns));
      last_s = std::fmax(last_s, in_seconds(robot.arrival_ns));
    }
    for (std::size_t robot = 0; robot < end.robots.size(); ++robot)
      sink.robot(
          "makespan_ratio", robot,
          end.robots[robot].arrival_ns >= 0 ? ratio(in_seconds(end.robots[robot].arrival_ns), first_s) : undefined);
    sink.system("makespan_ratio", all ? ratio(last_s, first_s) : undefined);
    give_mean(sink, "velocity_change", &VelocityChange::value);
    const auto robots = static_cast<double>(end.robots.size());
    sink.system("flow_rate", end.robots.empty()    ? undefined
                             : all && last_s > 0.0 ? robots / (gap_width_m * last_s)
                                                   : 0.0);
  }

 private:
  Param<double> gap_width_m =
      param("gap_width_m", 1.0).unit("m").range(0.01, 1000.0).doc("of the narrow place; 1: robots a second");

  static double ratio(double own_s, double first_s) { return first_s > 0.0 ? own_s / first_s : 1.0; }

  static Vec2 velocity(const RobotSample& now) {
    const Vec2 along = toolkit::from_angle(now.pose.theta);
    return now.velocity.v_x * along + now.velocity.v_y * toolkit::perpendicular(along);
  }

  void add_step(VelocityChange& own, std::size_t robot, const Sample& sample) override {
    own.changes_m_s.add(toolkit::norm(velocity(sample.robots[robot]) - own.last));
    own.has_moved = true;
  }
};

}  // namespace dmrp::metrics
