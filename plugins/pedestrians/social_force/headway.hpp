// SPDX-License-Identifier: MIT
// The distance that a person can walk straight ahead before touching another body.
//
// Moussaid, Helbing, Theraulaz: How simple rules determine pedestrian behavior and crowd disasters, PNAS 108 (2011):
// the desired speed is at most the distance to the first obstacle ahead, divided by a time gap. The forces alone do not
// slow a crowd down: in a homogeneous crowd, the forces from the front and from behind cancel.
#pragma once

#include <cmath>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::pedestrians {

// People do not follow bodies that approach them faster than this, m/s; they evade them.
inline constexpr double oncoming_speed = 0.2;

// How far a disc can move along the unit vector `way` before it touches a disc at `apart` (relative position) that
// moves at `velocity`, m; `reach_m` is the sum of the radii. Infinite where the other disc is not in the way or
// approaches; never negative.
inline double headway(Vec2 way, Vec2 apart, double reach_m, Vec2 velocity) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double ahead_m = toolkit::dot(way, apart);
  const double aside_m = toolkit::cross(way, apart);
  if (!(ahead_m > 0.0) || !(std::abs(aside_m) < reach_m)) return none;
  if (toolkit::dot(way, velocity) < -oncoming_speed) return none;
  return std::fmax(0.0, ahead_m - std::sqrt(reach_m * reach_m - aside_m * aside_m));
}

}  // namespace dmrp::pedestrians
