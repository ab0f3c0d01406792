// SPDX-License-Identifier: MIT
// unicycle.hpp: motion at a constant velocity, exactly: along a straight line or an arc.
#pragma once

#include <dmrp/values.h>

namespace dmrp::core {

// The pose after dt_s at this velocity in the robot's own frame. Headings stay in (-pi, pi].
dmrp_pose move(const dmrp_pose& pose, const dmrp_twist& velocity, double dt_s);

}  // namespace dmrp::core
