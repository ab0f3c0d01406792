// SPDX-License-Identifier: MIT
// smoothness.hpp: turning, acceleration and jerk of robots.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class Smoothness final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Sums over the active steps of one robot.
  struct Motion {
    CompensatedSum turned_rad, driven_m, velocity_change, acceleration_change;
    std::int64_t moved_ns = 0;  // the time over which velocity_change sums
    std::int64_t jerk_ns = 0;   // the time over which acceleration_change sums

    Pose last_pose;
    Vec2 last_velocity;           // in the robot's frame, m/s
    Vec2 last_acceleration;       // mean of the previous step, m/s^2
    std::int64_t last_dt_ns = 0;  // of the previous step; 0: there was none
    void add_step(const RobotSample& robot, std::int64_t dt_ns);
  };

  double irregularity(std::size_t robot) const;

  ActiveSteps active_;
  bool begun_ = false;
  std::vector<Motion> motions_;  // by robot
};

}  // namespace dmrp::metrics
