// SPDX-License-Identifier: MIT
// smoothness.hpp: how much robots turn, and how hard they speed up and brake.
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
    std::int64_t moved_ns = 0;  // over which the velocity's changes were summed
    std::int64_t shook_ns = 0;  // over which the acceleration's were

    Pose last_pose;
    Vec2 last_velocity;           // own frame, m/s
    Vec2 last_acceleration;       // mean of the step before, m/s^2
    std::int64_t last_dt_ns = 0;  // of the step before; 0: there was none
    void add_step(const RobotSample& robot, std::int64_t dt_ns);
  };

  double irregularity(std::size_t robot) const;

  ActiveSteps active_;
  bool begun_ = false;
  std::vector<Motion> motions_;  // a robot
};

}  // namespace dmrp::metrics
