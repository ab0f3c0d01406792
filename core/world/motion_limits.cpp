// SPDX-License-Identifier: MIT
#include "core/world/motion_limits.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {
namespace {

double approach(double value, double target, double step) {
  return value + std::clamp(target - value, -step, step);
}

}  // namespace

bool is_finite(const dmrp_twist& velocity) {
  return toolkit::is_finite({velocity.v_x, velocity.v_y}) && std::isfinite(velocity.omega);
}

dmrp_twist clip_to_limits(const dmrp_twist& command, const dmrp_limits& limits) {
  assert(is_finite(command));
  return {std::clamp(command.v_x, limits.v_min, limits.v_max), std::clamp(command.v_y, -limits.v_y_max, limits.v_y_max),
          std::clamp(command.omega, -limits.omega_max, limits.omega_max)};
}

dmrp_twist track(const dmrp_twist& velocity, const dmrp_twist& command, const dmrp_limits& limits, double dt_s) {
  const double dv = limits.a_max * dt_s;
  const dmrp_twist reached = {approach(velocity.v_x, command.v_x, dv), approach(velocity.v_y, command.v_y, dv),
                              approach(velocity.omega, command.omega, limits.alpha_max * dt_s)};
  // rounding may overshoot a limit by one bit
  return clip_to_limits(reached, limits);
}

}  // namespace dmrp::core
