// SPDX-License-Identifier: MIT
// motion_limits.hpp: the limits of a robot's drive.
#pragma once

#include <dmrp/robot.h>

namespace dmrp::core {

bool is_finite(const dmrp_twist& velocity);

// Clamps each component of a finite command to the velocity limits; v_y becomes 0 for differential drive (v_y_max == 0).
dmrp_twist clip_to_limits(const dmrp_twist& command, const dmrp_limits& limits);

// The velocity after one step: as near to the command as the acceleration limits allow.
dmrp_twist track(const dmrp_twist& velocity, const dmrp_twist& command, const dmrp_limits& limits, double dt_s);

}  // namespace dmrp::core
