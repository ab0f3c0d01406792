// SPDX-License-Identifier: MIT
#include "controllers/orca/allowed_velocities.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::orca {

namespace {

// Directions at which the boundary of the allowed velocities is computed, on either side of the heading.
constexpr int directions = 12;

// Below this angle, arc and straight line are the same.
constexpr double straight_rad = 1e-3;

// Whether `b` lies strictly to the left of the line from a to c.
bool bulges(Vec2 a, Vec2 b, Vec2 c) {
  return toolkit::cross(b - a, c - b) > 0.0;
}

}  // namespace

double arc_speed(double speed, double angle) {
  const double half = 0.5 * std::abs(angle);
  if (half < 0.5 * straight_rad) return speed;
  return speed * half / std::tan(half);
}

double arc_rate(const Follower& follower, double angle) {
  const double turn = std::abs(angle);
  const double fastest = follower.omega_max;
  const bool reaches_fastest = turn > fastest * fastest / follower.alpha_max;
  const double rest_to_rest_s =
      reaches_fastest ? turn / fastest + fastest / follower.alpha_max : 2.0 * std::sqrt(turn / follower.alpha_max);
  return angle / std::max(follower.align_s, rest_to_rest_s);
}

double tracking_error(const Follower& follower, double speed, double angle) {
  if (std::abs(angle) < straight_rad) return 0.0;
  const double rate = std::abs(arc_rate(follower, angle));
  const double turn = std::abs(angle);
  const double duration_s = turn / rate;
  const double radius_m = arc_speed(speed, angle) / rate;
  const Vec2 robot = {radius_m * std::sin(turn), radius_m * (1.0 - std::cos(turn))};
  return toolkit::distance(robot, speed * duration_s * toolkit::from_angle(turn));
}

double greatest_speed(const Follower& follower, double angle, double error_m) {
  // the error is proportional to the speed
  const double error_s = tracking_error(follower, 1.0, angle);
  return error_s * follower.v_max <= error_m ? follower.v_max : error_m / error_s;
}

void append_allowed(const Follower& follower, double error_m, double heading,
                    std::vector<reciprocal::HalfPlane>& planes) {
  // the boundary counter-clockwise, from straight backward on the right; its convex hull leaves out what bulges inward
  std::array<Vec2, 2 * directions> corners;
  std::size_t count = 0;
  for (int i = -directions; i < directions; ++i) {
    const double angle = toolkit::pi * i / directions;
    const Vec2 corner = greatest_speed(follower, angle, error_m) * toolkit::from_angle(angle);
    while (count >= 2 && !bulges(corners[count - 2], corners[count - 1], corner)) --count;
    corners[count++] = corner;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 from = corners[i];
    const Vec2 side = corners[(i + 1) % count] - from;
    planes.push_back({toolkit::rotate(from, heading), toolkit::rotate(toolkit::normalized(side), heading)});
  }
}

}  // namespace dmrp::controllers::orca
