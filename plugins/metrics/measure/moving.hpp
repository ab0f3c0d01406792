// SPDX-License-Identifier: MIT
// moving.hpp: discs that move, and when two of them touch at constant velocities.
#pragma once

#include <cmath>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

struct Moving {
  Disc disc;
  Vec2 velocity;  // m/s, world frame
};

inline Moving moving(const Robot& robot, const RobotSample& now) {
  return {disc_of(robot, now), world_velocity(now)};
}

inline Moving moving(const Person& person) {
  return {disc_of(person), person.velocity};
}

// The smallest tau > 0 with |dp + dv tau| = r1 + r2; 0 if they overlap already, NaN if they never meet.
inline double time_to_contact(const Moving& a, const Moving& b) {
  const Vec2 apart = b.disc.center - a.disc.center;
  const Vec2 drift = b.velocity - a.velocity;
  const double reach_m = a.disc.radius_m + b.disc.radius_m;
  const double gap = toolkit::squared_norm(apart) - reach_m * reach_m;
  if (gap < 0.0) return 0.0;
  const double approach = -toolkit::dot(apart, drift);
  if (!(approach > 0.0)) return undefined;
  const double discriminant = approach * approach - toolkit::squared_norm(drift) * gap;
  if (discriminant < 0.0) return undefined;
  return gap / (approach + std::sqrt(discriminant));  // the smaller root, without cancellation
}

}  // namespace dmrp::metrics
