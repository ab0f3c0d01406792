// SPDX-License-Identifier: MIT
// The functions of the collision-free speed model: the repulsion that turns people, and the speed that a gap permits.
//
// Tordeux, Chraibi, Seyfried: Collision-free speed model for pedestrian dynamics, Traffic and Granular Flow '15
// (Springer 2016), section 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// The repulsion from an obstacle at this gap, relative to the desired direction, which has the weight 1 (equation 4:
// a exp((l - s) / D)). An overlap does not increase it.
inline double repulsion(double strength, double range_m, double gap_m) {
  return strength * std::exp(-std::max(gap_m, 0.0) / range_m);
}

// Whether a body at `apart` (relative position, m) is in the way of a person who walks along the unit vector
// `direction`: ahead, and within the strip that both bodies together need (equation 2). `reach_m` is the sum of the
// radii.
inline bool is_in_the_way(Vec2 direction, Vec2 apart, double reach_m) {
  return toolkit::dot(direction, apart) >= 0.0 && std::abs(toolkit::cross(direction, apart)) <= reach_m;
}

// The speed that needs at least `time_gap_s` to cover the gap (equation 3). It never leads to a contact.
inline double permitted_speed(double wished_m_s, double gap_m, double time_gap_s) {
  return std::min(wished_m_s, std::max(0.0, gap_m) / time_gap_s);
}

}  // namespace dmrp::pedestrians
