// SPDX-License-Identifier: MIT
// The two functions of the collision-free speed model: which way somebody turns, and how fast they may go that way.
//
// Tordeux, Chraibi, Seyfried: Collision-free speed model for pedestrian dynamics, Traffic and Granular Flow '15
// (Springer 2016), section 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// How hard somebody turns away from what is this far from their own body, against the wish to go on, which is 1
// (equation 4: a exp((l - s) / D)). No harder in an overlap than in touch.
inline double repulsion(double strength, double range_m, double gap_m) {
  return strength * std::exp(-std::max(gap_m, 0.0) / range_m);
}

// Whether a body that is `apart` away (from self to other, m) is in the way of who walks along the unit vector
// `direction`: in front, and within the strip as broad as the two that meet in it (equation 2). `reach_m` is the sum of
// the radii.
inline bool is_in_the_way(dmrp_vec2 direction, dmrp_vec2 apart, double reach_m) {
  return toolkit::dot(direction, apart) >= 0.0 && std::abs(toolkit::cross(direction, apart)) <= reach_m;
}

// The speed that takes at least `time_gap_s` to cover a gap (equation 3): nobody who keeps to it comes to touch.
inline double permitted_speed(double wished_m_s, double gap_m, double time_gap_s) {
  return std::min(wished_m_s, std::max(0.0, gap_m) / time_gap_s);
}

}  // namespace dmrp::pedestrians
