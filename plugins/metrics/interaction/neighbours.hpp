// SPDX-License-Identifier: MIT
// neighbours.hpp: the number of other robots around a robot.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class Neighbours final : public ActiveTimeMetric<TimeCount> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.neighbours", "Neighbours")
        .summary("number of other robots around a robot until it arrives")
        .source("mean of the N(t) whose variance is LDF in Hu et al., DMRP-Bench, ICRA 2026, over active time")
        .value("neighbours", "1", Direction::none, system_and_robots,
               "mean over active time of the number of other robots, including parked ones, within radius_m; undefined "
               "if planning failed",
               never_negative);
  }

  Param<double> radius_m = param("radius_m", 2.0)
                               .unit("m")
                               .range(0.0, 1000.0)
                               .doc("R: robots at most this far away count, centre to centre");

  void observe(const Sample& sample) override {
    sort_robots(robots_, sample);
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override { give_mean(sink, "neighbours", &TimeCount::mean); }

 private:
  void add_step(TimeCount& near, std::size_t robot, const Sample& sample) override {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    const double squared_radius = radius_m * radius_m;
    std::int64_t count = -1;  // but for itself
    robots_.visit(position, radius_m, [&](std::size_t other) {
      count += toolkit::squared_distance(position, toolkit::position(sample.robots[other].pose)) <= squared_radius;
    });
    near.add(count, sample.dt_ns);
  }

  toolkit::NeighbourGrid robots_;  // at the sample
};

}  // namespace dmrp::metrics
