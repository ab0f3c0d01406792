// SPDX-License-Identifier: MIT
// drive.hpp: the motion of a robot's drive over one step, without contacts.
#pragma once

#include <dmrp/robot.h>

#include "core/scene/settings.hpp"

namespace dmrp::core {

struct DriveState {
  dmrp_pose pose{};
  dmrp_twist velocity{};      // in the robot's frame
  double steering_rad = 0.0;  // of the front wheels; Ackermann only
};

// The nearest command within the drive's ability. Must be finite.
// - differential: v_x and omega within their limits, v_y = 0
// - holonomic: also v_y within its limit
// - Ackermann: v_y = 0, and omega so that the steering angle atan(omega wheelbase_m / v_x) is within steering_max; at
//   v_x = 0 the robot cannot turn, so omega = 0
dmrp_twist clip_to_drive(const dmrp_twist& command, Drive drive, const dmrp_limits& limits);

// The state after dt_s: the velocity comes as near to the command as the acceleration limits allow, and is then
// constant during the step.
// - differential: an arc; a_max limits the change of v_x, alpha_max that of omega
// - holonomic: an arc; a_max limits the length of the change of (v_x, v_y)
// - Ackermann (kinematic bicycle; the origin is the middle of the rear axle): the wheels turn at steering_rate_max
//   toward the commanded angle within the step, omega = v_x tan(steering) / wheelbase_m at every moment. The heading is
//   exact, the place to 1e-12 m at the steps of a simulation. omega_max and alpha_max limit only the command.
DriveState advance(const DriveState& state, const dmrp_twist& command, Drive drive, const dmrp_limits& limits,
                   double dt_s);

}  // namespace dmrp::core
