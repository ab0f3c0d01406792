// SPDX-License-Identifier: MIT
#include "controllers/dwa/oscillation.hpp"

#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::dwa {

namespace {

// Below this speed a turn counts as a turn in place (min_vel_trans upstream).
constexpr double hardly_driving_m_s = 0.1;

// Sets `direction` to the sign of `value`; true if that reverses the earlier direction.
bool reverses(double value, int& direction) {
  if (value == 0.0) return false;
  const int now = value > 0.0 ? 1 : -1;
  const bool reversed = direction == -now;
  direction = now;
  return reversed;
}

}  // namespace

void OscillationGuard::release(const Pose& now, double reset_distance_m, double reset_angle_rad) {
  if (only_drive_ == 0 && only_turn_ == 0) return;
  const double moved_m = toolkit::distance(toolkit::position(since_), toolkit::position(now));
  if (moved_m > reset_distance_m || std::abs(toolkit::difference(since_.theta, now.theta)) > reset_angle_rad) reset();
}

void OscillationGuard::record(const Pose& now, const Sample& command) {
  bool reversed = false;
  if (reverses(command.v, drive_)) {
    only_drive_ = drive_;
    reversed = true;
  }
  const bool hardly_drives = std::abs(command.v) <= hardly_driving_m_s;
  if (hardly_drives && reverses(command.omega, turn_)) {
    only_turn_ = turn_;
    reversed = true;
  }
  if (hardly_drives && reverses(command.v_y, strafe_)) {
    only_strafe_ = strafe_;
    reversed = true;
  }
  if (reversed) since_ = now;
}

}  // namespace dmrp::controllers::dwa
