// SPDX-License-Identifier: MIT
#include "metrics/interaction/neighbours.hpp"

#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor Neighbours::describe() {
  return describe_metric("dmrp.metric.neighbours", "Neighbours")
      .summary("number of other robots around a robot until it arrives")
      .source("mean of the N(t) whose variance is LDF in Hu et al., DMRP-Bench, ICRA 2026, over active time")
      .value("neighbours", "1", Direction::none, Subjects::system_and_robots,
             "mean over active time of the number of other robots, including parked ones, within radius_m; undefined "
             "if planning failed");
}

void Neighbours::begin(const dmrp_plan*) {
  near_.begin(world().robots().size());
}

void Neighbours::observe(const Sample& sample) {
  const double squared_radius = radius_m * radius_m;
  near_.observe(sample, [&](Vec2 position) {
    std::int64_t near = -1;  // but for itself
    for (const RobotSample& other : sample.robots)
      near += toolkit::squared_distance(position, toolkit::position(other.pose)) <= squared_radius;
    return near;
  });
}

void Neighbours::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "neighbours", near_.means());
}

}  // namespace dmrp::metrics
