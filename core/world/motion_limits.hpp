// SPDX-License-Identifier: MIT
// motion_limits.hpp: what a robot's drive makes of a command.
#pragma once

#include <dmrp/robot.h>

namespace dmrp::core {

// The nearest command within the velocity limits, each component by itself. v_y is zeroed for differential drive
// (v_y_max == 0). The command must be finite.
dmrp_twist clip_to_limits(const dmrp_twist& command, const dmrp_limits& limits);

// The velocity one step later: as near to the command as the accelerations allow.
dmrp_twist track(const dmrp_twist& velocity, const dmrp_twist& command, const dmrp_limits& limits, double dt_s);

}  // namespace dmrp::core
