// SPDX-License-Identifier: MIT
#include "neighbours.hpp"

#include <dmrp/toolkit/vec2.hpp>

#include "../measure/describe_metric.hpp"
#include "../measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor Neighbours::describe() {
  return describe_metric("dmrp.metric.neighbours", "Neighbours")
      .summary("how many other robots a robot has around it on its way")
      .source("mean of the N(t) whose variance is LDF in Hu et al., DMRP-Bench, ICRA 2026, over active time")
      .value("neighbours", "1", Direction::none, Subjects::system_and_robots,
             "mean over its active time of the number of other robots, parked ones too, within radius_m; system: mean "
             "over robots; undefined if planning failed");
}

void Neighbours::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  times_.assign(world().robots().size(), {});
}

void Neighbours::observe(const Sample& sample) {
  active_.observe(sample);
  const double squared_radius = radius_m * radius_m;
  for (std::size_t robot = 0; robot < times_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    std::int64_t near = -1;  // but for itself
    for (const RobotSample& other : sample.robots)
      near += toolkit::squared_distance(position, toolkit::position(other.pose)) <= squared_radius;
    times_[robot].active_ns += sample.dt_ns;
    times_[robot].neighbour_ns += near * sample.dt_ns;
  }
}

void Neighbours::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "neighbours", values_of(times_, [](const Times& times) {
              return times.active_ns > 0
                         ? static_cast<double>(times.neighbour_ns) / static_cast<double>(times.active_ns)
                         : undefined;
            }));
}

}  // namespace dmrp::metrics
