// SPDX-License-Identifier: MIT
// unicycle.hpp: exact motion at constant velocity, along a straight line or an arc.
#pragma once

#include <dmrp/values.h>

namespace dmrp::core {

// The pose after dt_s at this velocity, given in the robot's frame. The heading is in (-pi, pi].
dmrp_pose move(const dmrp_pose& pose, const dmrp_twist& velocity, double dt_s);

}  // namespace dmrp::core
