// SPDX-License-Identifier: MIT
// The terms of the social force model as accelerations with weight 1, m/s2.
//
// Moussaid et al.: Experimental study of the behavioural mechanisms underlying self-organization in human crowds,
// Proc. R. Soc. B 276 (2009); groups: The walking behaviour of pedestrian social groups, PLoS ONE 5 (2010).
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// The shape of the interaction between two people.
struct InteractionShape {
  double lambda;   // weight of the relative velocity, compared with the direction to the other person
  double gamma;    // range of the interaction per unit of that sum, m
  double n;        // angular width of the turning force
  double n_prime;  // angular width of the decelerating force
};

// Forces below exp(-negligible_exponent) of the full weight are ignored.
inline constexpr double negligible_exponent = 5.0;

// The force of a person at `distance_m` along the unit vector `toward`; `approach` is the own velocity minus the
// other's. It decelerates along the direction of interaction and turns to the side away from the other person, to the
// right in an exactly head-on encounter.
inline Vec2 interaction(const InteractionShape& shape, Vec2 toward, double distance_m, Vec2 approach) {
  const Vec2 direction = shape.lambda * approach + toward;
  const double squared_length = toolkit::squared_norm(direction);
  const double largest_distance_m = negligible_exponent * shape.gamma;
  if (distance_m * distance_m > largest_distance_m * largest_distance_m * squared_length) return {0.0, 0.0};

  const double length = std::sqrt(squared_length);
  const double range_m = shape.gamma * length;
  const double decay = distance_m / range_m;
  const double slowing_width = shape.n_prime * range_m;
  const double turning_width = shape.n * range_m;
  const Vec2 along = direction / length;
  // theta^2 = u + u^2 / 12 + u^3 / 90 + ... with u = 2 - 2 cos(theta). All terms are positive, so this lower bound
  // rules out most people to the side without computing the angle.
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

// Decelerates a person who walks along `desired` and would have to turn the head by more than a right angle to see the
// group's centre, in proportion to the excess.
inline Vec2 gaze(Vec2 desired, Vec2 velocity, Vec2 to_center) {
  const double angle =
      std::atan2(std::abs(toolkit::cross(desired, to_center)), toolkit::dot(desired, to_center));  // in [0, pi]
  return -std::max(0.0, angle - 0.5 * toolkit::pi) * velocity;
}

}  // namespace dmrp::pedestrians
