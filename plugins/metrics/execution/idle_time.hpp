// SPDX-License-Identifier: MIT
// idle_time.hpp: the time in which robots stand still before they arrive.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class IdleTime final : public ActiveTimeMetric<TimeCount> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.idle_time", "Idle time")
        .summary("time in which an active robot neither drives nor turns")
        .source("HuNavSim, Perez-Higueras et al., RA-L 2023: time not moving")
        .value("idle_time", "s", lower_is_better, system_and_robots,
               "active time with measured |v| < 0.01 m/s and |omega| < 0.02 rad/s; undefined if planning failed",
               never_negative);
  }

  void finish(const TrialEnd&, MetricSink& sink) override { give_mean(sink, "idle_time", &TimeCount::seconds); }

 private:
  static constexpr double still_speed = 0.01;  // m/s
  static constexpr double still_omega = 0.02;  // rad/s

  void add_step(TimeCount& idle, std::size_t robot, const Sample& sample) override {
    const RobotSample& now = sample.robots[robot];
    idle.add(speed_of(now) < still_speed && std::fabs(now.velocity.omega) < still_omega, sample.dt_ns);
  }
};

}  // namespace dmrp::metrics
