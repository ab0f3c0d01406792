// SPDX-License-Identifier: MIT
// residuals.hpp: the residuals of a band's cost and their derivatives.
//
// The formulas are those of teb_local_planner's edges; the derivatives are analytic. A residual depends on a block of
// consecutive variables (x, y, theta, dt of one pose, then of the next): 7 between two poses, 11 among three.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::teb {

inline constexpr std::size_t pair_block = 7;     // pose, dt, pose
inline constexpr std::size_t triple_block = 11;  // pose, dt, pose, dt, pose

// A penalty and its derivative: linear outside the bounds, zero inside.
struct Penalty {
  double error = 0.0;
  double slope = 0.0;
};

// Penalises values below low + margin.
inline Penalty above(double value, double low, double margin) {
  return value < low + margin ? Penalty{low + margin - value, -1.0} : Penalty{};
}

// Raises a penalty to a power: scale (error / scale)^exponent.
inline Penalty raised(Penalty penalty, double exponent, double scale) {
  if (exponent == 1.0 || !(penalty.error > 0.0) || !(scale > 0.0)) return penalty;
  const double error = scale * std::pow(penalty.error / scale, exponent);
  return {error, penalty.slope * exponent * error / penalty.error};
}

// Penalises values outside [low + margin, high - margin]. A lower bound of 0 has no margin: standing costs nothing.
inline Penalty within(double value, double low, double high, double margin) {
  const double floor = low < 0.0 ? std::min(low + margin, 0.0) : low;
  if (value < floor) return {floor - value, -1.0};
  const double ceiling = high - margin;
  if (value > ceiling) return {value - ceiling, 1.0};
  return {};
}

// A pose and the unit vector of its heading, computed once per evaluation.
struct DirectedPose {
  Vec2 at;
  double theta;
  Vec2 heading;
};

// The length of a vector, differentiable at zero.
inline double smooth_norm(Vec2 a) {
  return std::sqrt(toolkit::squared_norm(a) + 1e-12);
}

// The mean velocity between two poses dt apart, and its derivatives with respect to their 7 variables.
struct Motion {
  double v = 0.0;      // m/s; the sign of the chord's projection on the first heading, smoothed over a centimetre
  double omega = 0.0;  // rad/s
  std::array<double, pair_block> v_by = {};
  std::array<double, pair_block> omega_by = {};
};

// One component of a mean velocity, and its derivatives.
struct Velocity {
  double value = 0.0;  // m/s
  std::array<double, pair_block> by = {};
};

template <bool with_derivatives>
inline void motion_between(const DirectedPose& a, const DirectedPose& b, double dt_s, Motion& motion) {
  constexpr double sharpness = 100.0;  // 1/m
  const Vec2 chord = b.at - a.at;
  const double inverse_dt = 1.0 / dt_s;
  const double distance = smooth_norm(chord);
  const double ahead = sharpness * toolkit::dot(chord, a.heading);
  const double smoothing = 1.0 / (1.0 + std::abs(ahead));
  const double sign = ahead * smoothing;
  motion.v = distance * sign * inverse_dt;
  motion.omega = toolkit::wrap(b.theta - a.theta) * inverse_dt;
  if constexpr (with_derivatives) {
    const double by_distance = sign * inverse_dt / distance;
    const double by_ahead = distance * sharpness * smoothing * smoothing * inverse_dt;
    const Vec2 by = by_distance * chord + by_ahead * a.heading;
    const double by_theta = by_ahead * toolkit::cross(a.heading, chord);
    motion.v_by = {-by.x, -by.y, by_theta, -motion.v * inverse_dt, by.x, by.y, 0.0};
    motion.omega_by = {0.0, 0.0, -inverse_dt, -motion.omega * inverse_dt, 0.0, 0.0, inverse_dt};
  }
}

// The mean velocity of a holonomic drive between two poses dt apart: motion.v ahead, `aside` to the left. Sets the rest
// of `motion` too.
template <bool with_derivatives>
inline void holonomic_motion_between(const DirectedPose& a, const DirectedPose& b, double dt_s, Motion& motion,
                                     Velocity& aside) {
  const Vec2 chord = b.at - a.at;
  const Vec2 ahead = a.heading;
  const Vec2 left = toolkit::perpendicular(ahead);
  const double inverse_dt = 1.0 / dt_s;
  motion.v = toolkit::dot(chord, ahead) * inverse_dt;
  aside.value = toolkit::dot(chord, left) * inverse_dt;
  motion.omega = toolkit::wrap(b.theta - a.theta) * inverse_dt;
  if constexpr (with_derivatives) {
    const Vec2 by_x = inverse_dt * ahead;
    const Vec2 by_y = inverse_dt * left;
    motion.v_by = {-by_x.x, -by_x.y, aside.value, -motion.v * inverse_dt, by_x.x, by_x.y, 0.0};
    aside.by = {-by_y.x, -by_y.y, -motion.v, -aside.value * inverse_dt, by_y.x, by_y.y, 0.0};
    motion.omega_by = {0.0, 0.0, -inverse_dt, -motion.omega * inverse_dt, 0.0, 0.0, inverse_dt};
  }
}

// A residual and its derivatives by a block of variables.
template <std::size_t size>
struct Residual {
  double error = 0.0;
  std::array<double, size> by = {};
};

// Zero if both poses lie on one arc: the chord then has the direction of the mean heading.
inline Residual<pair_block> non_holonomic(const DirectedPose& a, const DirectedPose& b) {
  const Vec2 chord = b.at - a.at;
  const Vec2 mean = a.heading + b.heading;
  const auto by_theta = [chord](Vec2 heading) { return -heading.y * chord.y - heading.x * chord.x; };
  return {toolkit::cross(mean, chord),
          {mean.y, -mean.x, by_theta(a.heading), 0.0, -mean.y, mean.x, by_theta(b.heading)}};
}

// The chord's projection on the first heading: positive for driving forward.
inline Residual<pair_block> forward(const DirectedPose& a, const DirectedPose& b) {
  const Vec2 chord = b.at - a.at;
  const Vec2 ahead = a.heading;
  return {toolkit::dot(chord, ahead), {-ahead.x, -ahead.y, toolkit::cross(ahead, chord), 0.0, ahead.x, ahead.y, 0.0}};
}

// The radius of the arc between two poses: their distance divided by the angle. Far larger than any least radius if the
// robot does not turn.
inline Residual<pair_block> turning_radius(const DirectedPose& a, const DirectedPose& b) {
  constexpr double straight_rad = 1e-4;
  constexpr double straight_m = 1e6;
  const double turned = toolkit::wrap(b.theta - a.theta);
  const double angle = std::abs(turned);
  if (angle < straight_rad) return {straight_m, {}};
  const Vec2 chord = b.at - a.at;
  const double distance = smooth_norm(chord);
  const Vec2 by = chord / (distance * angle);
  const double by_theta = -std::copysign(distance / (angle * angle), turned);
  return {distance / angle, {-by.x, -by.y, -by_theta, 0.0, by.x, by.y, by_theta}};
}

// The distance between two poses.
inline Residual<pair_block> length(const DirectedPose& a, const DirectedPose& b) {
  const Vec2 chord = b.at - a.at;
  const double distance = smooth_norm(chord);
  const Vec2 by = chord / distance;
  return {distance, {-by.x, -by.y, 0.0, 0.0, by.x, by.y, 0.0}};
}

// The acceleration from one interval to the next: 2 (second - first) / (dt_first + dt_second).
// `first_by`, `second_by`: the derivatives of the velocities.
inline Residual<triple_block> acceleration(double first, const std::array<double, pair_block>& first_by, double second,
                                           const std::array<double, pair_block>& second_by, double dt_first,
                                           double dt_second) {
  const double scale = 2.0 / (dt_first + dt_second);
  Residual<triple_block> result;
  result.error = (second - first) * scale;
  for (std::size_t i = 0; i < pair_block; ++i) {
    result.by[i] -= scale * first_by[i];
    result.by[i + 4] += scale * second_by[i];
  }
  const double by_dt = -result.error / (dt_first + dt_second);
  result.by[3] += by_dt;
  result.by[7] += by_dt;
  return result;
}

// The acceleration within the first interval from a given start velocity; with direction -1, within the last interval
// to a given velocity at the goal.
inline Residual<pair_block> end_acceleration(double given, double velocity, const std::array<double, pair_block>& by,
                                             double dt_s, double direction) {
  Residual<pair_block> result;
  result.error = direction * (velocity - given) / dt_s;
  for (std::size_t i = 0; i < pair_block; ++i) result.by[i] = direction * by[i] / dt_s;
  result.by[3] -= result.error / dt_s;
  return result;
}

}  // namespace dmrp::controllers::teb
