// SPDX-License-Identifier: MIT
// oscillation.hpp: forbids to go back and forth on the spot.
#ifndef DMRP_CONTROLLERS_DWA_OSCILLATION_HPP
#define DMRP_CONTROLLERS_DWA_OSCILLATION_HPP

#include <dmrp/values.h>

namespace dmrp::controllers::dwa {

// Once the robot has reversed its direction of driving, or of turning while it hardly drives, only the new direction
// is allowed, until it has moved by `reset_distance_m` or turned by `reset_angle_rad` from where that began.
// Asking changes nothing: the flags are the robot's history, not that of the samples tried.
class OscillationGuard {
 public:
  void reset() { *this = OscillationGuard(); }

  bool allows(double v, double omega) const {
    return (only_drive_ == 0 || v * only_drive_ >= 0.0) && (only_turn_ == 0 || omega * only_turn_ >= 0.0);
  }

  // Once a control period: first where the robot is now, then what it has been told to do.
  void release(const dmrp_pose& now, double reset_distance_m, double reset_angle_rad);
  void note(const dmrp_pose& now, double v, double omega);

 private:
  int drive_ = 0;  // direction last commanded: 1, -1, or 0 for none yet
  int turn_ = 0;
  int only_drive_ = 0;  // the direction allowed; 0: both
  int only_turn_ = 0;
  dmrp_pose since_ = {0.0, 0.0, 0.0};
};

}  // namespace dmrp::controllers::dwa

#endif
