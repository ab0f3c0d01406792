// SPDX-License-Identifier: MIT
// oscillation.hpp: prevents a robot from moving back and forth on the spot.
#pragma once

#include <dmrp/cpp/local_controller.hpp>

#include "controllers/dwa/velocity_window.hpp"

namespace dmrp::controllers::dwa {

// After the robot has reversed its driving direction, or its turning or sideways direction while it hardly drives
// ahead, only the new direction is allowed until it has moved by `reset_distance_m` or turned by `reset_angle_rad` since
// the reversal. allows() changes nothing: the state is the history of the robot's commands, not of the samples tried.
class OscillationGuard {
 public:
  void reset() { *this = OscillationGuard(); }

  bool allows(const Sample& sample) const {
    return (only_drive_ == 0 || sample.v * only_drive_ >= 0.0) &&
           (only_turn_ == 0 || sample.omega * only_turn_ >= 0.0) &&
           (only_strafe_ == 0 || sample.v_y * only_strafe_ >= 0.0);
  }

  // Both once per control period: release() with the current pose, then record() with the command.
  void release(const Pose& now, double reset_distance_m, double reset_angle_rad);
  void record(const Pose& now, const Sample& command);

 private:
  int drive_ = 0;  // the last commanded direction: 1, -1, or 0 if there is none
  int turn_ = 0;
  int strafe_ = 0;
  int only_drive_ = 0;  // the only direction allowed; 0: both
  int only_turn_ = 0;
  int only_strafe_ = 0;
  Pose since_ = {0.0, 0.0, 0.0};
};

}  // namespace dmrp::controllers::dwa
