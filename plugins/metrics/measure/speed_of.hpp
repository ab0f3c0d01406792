// SPDX-License-Identifier: MIT
// speed_of.hpp: the measured speed of a robot.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

// |v| as measured, not as commanded, m/s. (sqrt is correctly rounded in every libm, hypot is not.)
inline double speed_of(const RobotSample& robot) {
  return std::sqrt(robot.velocity.v_x * robot.velocity.v_x + robot.velocity.v_y * robot.velocity.v_y);
}

}  // namespace dmrp::metrics
