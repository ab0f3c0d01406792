// SPDX-License-Identifier: MIT
// The half-plane of velocities that somebody permits themselves on account of another body that moves.
//
// Van den Berg, Guy, Lin, Manocha: Reciprocal n-body collision avoidance, ISRR 2009 (Springer 2011), section 4.
#pragma once

#include <cmath>

#include "pedestrians/orca/half_plane.hpp"

namespace dmrp::pedestrians {

// Another body, seen by somebody.
struct Encounter {
  dmrp_vec2 apart;     // from self to the other, m; not zero
  dmrp_vec2 approach;  // own velocity minus the other's, m/s
  double reach_m;      // sum of the radii
};

// The change of `approach` that brings it to the border of the velocity obstacle, and the border's normal there.
struct Escape {
  dmrp_vec2 change;
  dmrp_vec2 normal;  // unit vector, out of the velocity obstacle
};

// The velocity obstacle holds every approach that brings the two together within `horizon_s`: the cone over the disc of
// radius reach_m at `apart`, cut off by that disc scaled by 1 / horizon_s. Who overlaps already gets out of it in the
// time `step_s`.
inline Escape escape(const Encounter& met, double horizon_s, double step_s) {
  const double squared_distance = toolkit::squared_norm(met.apart);
  const double squared_reach = met.reach_m * met.reach_m;
  const bool overlap = squared_distance < squared_reach;
  const double within_s = overlap ? step_s : horizon_s;

  // from the centre of the cut-off disc; it is nearest to that disc where it lies between the cone's tangent points
  const dmrp_vec2 from_center = met.approach - met.apart / within_s;
  const double squared_length = toolkit::squared_norm(from_center);
  const double along = toolkit::dot(from_center, met.apart);
  if (overlap || (along < 0.0 && along * along > squared_reach * squared_length)) {
    const double length = std::sqrt(squared_length);
    const dmrp_vec2 normal = length > 0.0 ? from_center / length : toolkit::normalized(-met.apart);
    return {normal * (met.reach_m / within_s - length), normal};
  }

  // the leg on whose side the approach is
  const double leg_m = std::sqrt(squared_distance - squared_reach);
  const double side = toolkit::cross(met.apart, from_center) > 0.0 ? 1.0 : -1.0;
  const dmrp_vec2 leg =
      (met.apart * leg_m + toolkit::perpendicular(met.apart) * (side * met.reach_m)) / squared_distance;
  const dmrp_vec2 normal = toolkit::perpendicular(leg) * side;
  return {normal * -toolkit::dot(met.approach, normal), normal};
}

// Somebody who walks at `velocity` takes this share of the change upon themselves and counts on the other for the rest.
inline HalfPlane give_way(const Escape& away, dmrp_vec2 velocity, double share) {
  return half_plane(velocity + share * away.change, away.normal);
}

}  // namespace dmrp::pedestrians
