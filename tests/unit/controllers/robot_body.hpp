// SPDX-License-Identifier: MIT
// robot_body.hpp: footprints and limits of robots.
#pragma once

#include <dmrp/robot.h>

#include <cstdint>
#include <vector>

namespace dmrp::test {

inline dmrp_footprint disc_footprint(double radius_m) {
  return {sizeof(dmrp_footprint), 0, radius_m, radius_m, nullptr, 0, 0};
}

// Points to the corners.
inline dmrp_polygon polygon_of(const std::vector<dmrp_vec2>& corners) {
  return {corners.data(), static_cast<std::uint32_t>(corners.size()), 0};
}

// Points to the parts.
inline dmrp_footprint polygon_footprint(const std::vector<dmrp_polygon>& parts, double radius_m,
                                        double inscribed_radius_m) {
  return {sizeof(dmrp_footprint),
          static_cast<std::uint32_t>(parts.size()),
          radius_m,
          inscribed_radius_m,
          parts.data(),
          sizeof(dmrp_polygon),
          0};
}

inline dmrp_limits differential_limits(double v_min, double v_max, double omega_max, double a_max, double alpha_max) {
  return {sizeof(dmrp_limits), 0, v_min, v_max, 0.0, omega_max, a_max, alpha_max, 0.0, 0.0, 0.0};
}

inline dmrp_limits holonomic_limits(double v_min, double v_max, double v_y_max, double omega_max, double a_max,
                                    double alpha_max) {
  return {sizeof(dmrp_limits), 0, v_min, v_max, v_y_max, omega_max, a_max, alpha_max, 0.0, 0.0, 0.0};
}

inline dmrp_limits ackermann_limits(double v_min, double v_max, double a_max, double wheelbase_m, double steering_max) {
  return {sizeof(dmrp_limits), 0, v_min, v_max, 0.0, 1.0, a_max, 1.0, wheelbase_m, steering_max, 1.0};
}

}  // namespace dmrp::test
