// SPDX-License-Identifier: MIT
// speed_of.hpp: how fast a robot really moves.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

// |v| as measured, m/s; what was commanded is another thing. (sqrt, not hypot: it is the same in every libm.)
inline double speed_of(const RobotSample& robot) {
  return std::sqrt(robot.velocity.v_x * robot.velocity.v_x + robot.velocity.v_y * robot.velocity.v_y);
}

}  // namespace dmrp::metrics
