// SPDX-License-Identifier: MIT
// The terms of the social force model as accelerations, m/s2, with weight 1.
//
// Moussaid et al.: Experimental study of the behavioural mechanisms underlying self-organization in human crowds,
// Proc. R. Soc. B 276 (2009); groups: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010).
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// The shape of the interaction between two people.
struct InteractionShape {
  double lambda;   // weight of the relative velocity against the direction to the other
  double gamma;    // range of the interaction per unit of that sum, m
  double n;        // angular width of turning aside
  double n_prime;  // angular width of slowing down
};

// Influences smaller than exp(-this) are left out.
inline constexpr double negligible_exponent = 5.0;

// How somebody minds another who is `distance_m` away along the unit vector `toward` and to whom their own velocity is
// `approach` (own minus the other's): slowing down along the interaction's direction, and turning to the side on
// which the other is not. Who meets another exactly head-on turns right.
inline dmrp_vec2 interaction(const InteractionShape& shape, dmrp_vec2 toward, double distance_m, dmrp_vec2 approach) {
  const dmrp_vec2 direction = shape.lambda * approach + toward;
  const double squared_length = toolkit::squared_norm(direction);
  const double furthest_m = negligible_exponent * shape.gamma;
  if (distance_m * distance_m > furthest_m * furthest_m * squared_length) return {0.0, 0.0};

  const double length = std::sqrt(squared_length);
  const double range_m = shape.gamma * length;
  const double decay = distance_m / range_m;
  const double slowing_width = shape.n_prime * range_m;
  const double turning_width = shape.n * range_m;
  const dmrp_vec2 along = direction / length;
  // theta^2 = u + u^2 / 12 + u^3 / 90 + ... with u = 2 - 2 cos(theta), all terms positive: most of those aside are told
  // without the angle itself
  const double cosine = toolkit::dot(along, toward);
  const double u = 2.0 - 2.0 * cosine;
  const double width = std::min(slowing_width, turning_width);
  if (decay + width * width * u * (1.0 + u * (1.0 / 12.0 + u / 90.0)) > negligible_exponent) return {0.0, 0.0};

  const double theta = std::atan2(toolkit::cross(along, toward), cosine);
  const double squared_theta = theta * theta;
  const double slowing = std::exp(-decay - slowing_width * slowing_width * squared_theta);
  const double turning = std::exp(-decay - turning_width * turning_width * squared_theta);
  return -slowing * along + (theta < 0.0 ? turning : -turning) * toolkit::perpendicular(along);
}

// Who walks along `desired` and has to turn the head further than a right angle to see the group's centre slows down by
// how much further that is.
inline dmrp_vec2 gaze(dmrp_vec2 desired, dmrp_vec2 velocity, dmrp_vec2 to_center) {
  const double angle =
      std::atan2(std::abs(toolkit::cross(desired, to_center)), toolkit::dot(desired, to_center));  // in [0, pi]
  return -std::max(0.0, angle - 0.5 * toolkit::pi) * velocity;
}

}  // namespace dmrp::pedestrians
