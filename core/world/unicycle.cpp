// SPDX-License-Identifier: MIT
#include "core/world/unicycle.hpp"

#include <cmath>
#include <dmrp/toolkit/angle.hpp>

namespace dmrp::core {
namespace {

// sin(x) / x
double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
}

}  // namespace

dmrp_pose move(const dmrp_pose& pose, const dmrp_twist& velocity, double dt_s) {
  // the chord of an arc has its mean heading and the arc's length times sinc of half the turn
  const double half_turn = 0.5 * velocity.omega * dt_s;
  const double heading = pose.theta + half_turn;
  const double chord = dt_s * sinc(half_turn);
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  return {pose.x + chord * (velocity.v_x * c - velocity.v_y * s),
          pose.y + chord * (velocity.v_x * s + velocity.v_y * c), toolkit::wrap(heading + half_turn)};
}

}  // namespace dmrp::core
