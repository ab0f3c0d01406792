// SPDX-License-Identifier: MIT
// headway.hpp: how far somebody can go straight ahead before touching another.
//
// Moussaid, Helbing, Theraulaz: How simple rules determine pedestrian behavior and crowd disasters, PNAS 108 (2011): the
// desired speed is at most the distance to the first obstacle ahead over a time gap. The forces alone don't slow a
// crowd down: in an even one the pushes from before and from behind cancel.
#pragma once

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::pedestrians {

// Who comes toward somebody faster than this is evaded, not followed, m/s.
inline constexpr double oncoming_speed = 0.2;

// How far a disc can go along the unit vector `way` before it touches another that is `apart` away (from self to other)
// and moves at `velocity`, m; `reach_m` is the sum of the radii. Infinite where the other is not in the way or comes
// toward; negative never.
inline double headway(dmrp_vec2 way, dmrp_vec2 apart, double reach_m, dmrp_vec2 velocity) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const double ahead_m = toolkit::dot(way, apart);
  const double aside_m = toolkit::cross(way, apart);
  if (!(ahead_m > 0.0) || !(std::abs(aside_m) < reach_m)) return none;
  if (toolkit::dot(way, velocity) < -oncoming_speed) return none;
  return std::fmax(0.0, ahead_m - std::sqrt(reach_m * reach_m - aside_m * aside_m));
}

}  // namespace dmrp::pedestrians
