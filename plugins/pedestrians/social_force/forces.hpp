// SPDX-License-Identifier: MIT
// The terms of the social force model as accelerations, m/s2, with weight 1.
//
// Moussaid et al.: Experimental study of the behavioural mechanisms underlying self-organization in human crowds,
// Proc. R. Soc. B 276 (2009); groups: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010).
#pragma once

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// The shape of the interaction between two people.
struct InteractionShape {
  double lambda;   // weight of the relative velocity against the direction to the other
  double gamma;    // range of the interaction per unit of that sum, m
  double n;        // angular width of turning aside
  double n_prime;  // angular width of slowing down
};

// Terms smaller than exp(-this) are left out.
inline constexpr double negligible_exponent = 5.0;

// How somebody minds another who is `apart` away (from self to other, `distance_m` long) and to whom their own velocity
// is `approach` (own minus the other's): slowing down along the interaction's direction, and turning to the side on
// which the other is not. Who meets another exactly head-on turns right.
inline dmrp_vec2 interaction(const InteractionShape& shape, dmrp_vec2 apart, double distance_m, dmrp_vec2 approach) {
  const dmrp_vec2 toward = apart / distance_m;
  const dmrp_vec2 direction = shape.lambda * approach + toward;
  const double length = toolkit::norm(direction);
  const double range_m = shape.gamma * length;
  if (distance_m > negligible_exponent * range_m) return {0.0, 0.0};

  const double parallel = toolkit::dot(direction, toward);  // both times `length`
  const double lateral = toolkit::cross(direction, toward);
  const double theta = std::atan2(lateral, parallel);
  const double decay = distance_m / range_m;
  const double slowing_angle = shape.n_prime * range_m * theta;
  const double turning_angle = shape.n * range_m * theta;
  const double slowing = std::exp(-decay - slowing_angle * slowing_angle);
  const double turning = std::exp(-decay - turning_angle * turning_angle);
  const dmrp_vec2 along = direction / length;
  return -slowing * along + (theta < 0.0 ? turning : -turning) * toolkit::perpendicular(along);
}

}  // namespace dmrp::pedestrians
