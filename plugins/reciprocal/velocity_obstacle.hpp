// SPDX-License-Identifier: MIT
// The half-plane of velocities that a moving neighbour permits.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), section 4.
#pragma once

#include <cassert>
#include <cmath>

#include "reciprocal/half_plane.hpp"

namespace dmrp::reciprocal {

// A neighbour, relative to the person or robot that chooses.
struct Encounter {
  Vec2 apart;      // from the chooser to the neighbour, m; not zero
  Vec2 approach;   // its velocity minus the neighbour's, m/s
  double reach_m;  // sum of the radii
};

// The smallest change of `approach` that moves it to the border of the velocity obstacle (u in the paper), and the
// border's normal there.
struct Escape {
  Vec2 change;
  Vec2 normal;  // unit vector, out of the velocity obstacle
};

// The velocity obstacle contains every approach that leads to a contact within `horizon_s`: the cone over the disc of
// radius reach_m at `apart`, truncated by this disc scaled by 1 / horizon_s. Bodies that overlap already separate
// within `step_s`.
inline Escape escape(const Encounter& met, double horizon_s, double step_s) {
  assert(met.apart != (Vec2{0.0, 0.0}) && met.reach_m >= 0.0 && horizon_s > 0.0 && step_s > 0.0);
  const double squared_distance = toolkit::squared_norm(met.apart);
  const double squared_reach = met.reach_m * met.reach_m;
  const bool overlap = squared_distance < squared_reach;
  const double within_s = overlap ? step_s : horizon_s;

  // relative to the centre of the truncating disc; the disc is nearest where this lies between the tangent points
  const Vec2 from_center = met.approach - met.apart / within_s;
  const double squared_length = toolkit::squared_norm(from_center);
  const double along = toolkit::dot(from_center, met.apart);
  if (overlap || (along < 0.0 && along * along > squared_reach * squared_length)) {
    const double length = std::sqrt(squared_length);
    const Vec2 normal = length > 0.0 ? from_center / length : toolkit::normalized(-met.apart);
    return {normal * (met.reach_m / within_s - length), normal};
  }

  // otherwise the leg on the side of the approach is nearest
  const double leg_m = std::sqrt(squared_distance - squared_reach);
  const double side = toolkit::cross(met.apart, from_center) > 0.0 ? 1.0 : -1.0;
  const Vec2 leg = (met.apart * leg_m + toolkit::perpendicular(met.apart) * (side * met.reach_m)) / squared_distance;
  const Vec2 normal = toolkit::perpendicular(leg) * side;
  return {normal * -toolkit::dot(met.approach, normal), normal};
}

// Whoever is at `velocity` makes this share of the change and expects the neighbour to make the rest.
inline HalfPlane give_way(const Escape& away, Vec2 velocity, double share) {
  assert(share >= 0.0 && share <= 1.0);
  return half_plane(velocity + share * away.change, away.normal);
}

}  // namespace dmrp::reciprocal
