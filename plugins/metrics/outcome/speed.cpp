// SPDX-License-Identifier: MIT
#include "metrics/outcome/speed.hpp"

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/speed_of.hpp"

namespace dmrp::metrics {

Descriptor Speed::describe() {
  return describe_metric("dmrp.metric.speed", "Speed")
      .summary("each robot's measured speed until it arrives")
      .source("Hu et al., DMRP-Bench, ICRA 2026: mean speed, speed standard deviation")
      .value("mean_speed", "m/s", Direction::higher_is_better, Subjects::system_and_robots,
             "mean over active time of the robot's measured |v|; undefined if planning failed")
      .value("speed_sd", "m/s", Direction::lower_is_better, Subjects::system_and_robots,
             "standard deviation over active time of the robot's measured |v|; undefined if planning failed");
}

void Speed::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  speed_.assign(world().robots().size(), {});
}

void Speed::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < speed_.size(); ++robot)
    if (active_.in_step(robot)) speed_[robot].add(speed_of(sample.robots[robot]), sample.dt_ns);
}

void Speed::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "mean_speed", values_of(speed_, [](const TimeMoments& speed) { return speed.mean(); }));
  give_mean(sink, "speed_sd", values_of(speed_, [](const TimeMoments& speed) { return speed.standard_deviation(); }));
}

}  // namespace dmrp::metrics
