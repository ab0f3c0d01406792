// SPDX-License-Identifier: MIT
#include "metrics/execution/idle_time.hpp"

#include <cmath>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/speed_of.hpp"

namespace dmrp::metrics {
namespace {

constexpr double still_speed = 0.01;  // m/s
constexpr double still_omega = 0.02;  // rad/s

}  // namespace

Descriptor IdleTime::describe() {
  return describe_metric("dmrp.metric.idle_time", "Idle time")
      .summary("time in which an active robot neither drives nor turns")
      .source("HuNavSim, Perez-Higueras et al., RA-L 2023: time not moving")
      .value("idle_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "active time with measured |v| < 0.01 m/s and |omega| < 0.02 rad/s; undefined if planning failed");
}

void IdleTime::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  times_.assign(world().robots().size(), {});
}

void IdleTime::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < times_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    const RobotSample& now = sample.robots[robot];
    times_[robot].active_ns += sample.dt_ns;
    if (speed_of(now) < still_speed && std::fabs(now.velocity.omega) < still_omega)
      times_[robot].idle_ns += sample.dt_ns;
  }
}

void IdleTime::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "idle_time", values_of(times_, [](const Times& times) {
              return times.active_ns > 0 ? in_seconds(times.idle_ns) : undefined;
            }));
}

}  // namespace dmrp::metrics
