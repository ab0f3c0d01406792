// SPDX-License-Identifier: MIT
// residuals.hpp: what a band is judged by, each residual with its derivatives.
//
// Formulas as teb_local_planner's edges have them; derivatives are analytic. A block of variables is a run of the
// band's: x, y, theta, dt of one pose, then of the next. So between two poses: 7 variables, among three: 11.
#ifndef DMRP_CONTROLLERS_TEB_RESIDUALS_HPP
#define DMRP_CONTROLLERS_TEB_RESIDUALS_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/angle.hpp>

namespace dmrp::controllers::teb {

inline constexpr std::size_t pair_block = 7;     // pose, dt, pose
inline constexpr std::size_t triple_block = 11;  // pose, dt, pose, dt, pose

// A penalty and its derivative, linear outside the bounds, nothing inside them.
struct Penalty {
  double error = 0.0;
  double slope = 0.0;
};

// Of what should stay above low + margin.
inline Penalty above(double value, double low, double margin) {
  return value < low + margin ? Penalty{low + margin - value, -1.0} : Penalty{};
}

// The same penalty to a power: scale (error / scale)^exponent.
inline Penalty raised(Penalty penalty, double exponent, double scale) {
  if (exponent == 1.0 || !(penalty.error > 0.0) || !(scale > 0.0)) return penalty;
  const double error = scale * std::pow(penalty.error / scale, exponent);
  return {error, penalty.slope * exponent * error / penalty.error};
}

// Of what should stay between low + margin and high - margin. A lower bound of 0 has no margin: standing is no offence.
inline Penalty within(double value, double low, double high, double margin) {
  const double floor = low < 0.0 ? std::min(low + margin, 0.0) : low;
  if (value < floor) return {floor - value, -1.0};
  const double ceiling = high - margin;
  if (value > ceiling) return {value - ceiling, 1.0};
  return {};
}

// A pose with its direction, computed once per evaluation.
struct DirectedPose {
  double x;
  double y;
  double theta;
  double cos_theta;
  double sin_theta;
};

// The mean velocity between two poses dt apart, and its derivatives with respect to their 7 variables.
struct Motion {
  double v = 0.0;      // m/s; its sign that of the way's projection on the first heading, blurred over a centimetre
  double omega = 0.0;  // rad/s
  std::array<double, pair_block> v_by = {};
  std::array<double, pair_block> omega_by = {};
};

template <bool with_derivatives>
inline void move_between(const DirectedPose& a, const DirectedPose& b, double dt_s, Motion& motion) {
  constexpr double sharpness = 100.0;  // 1/m
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double inverse_dt = 1.0 / dt_s;
  const double distance = std::sqrt(dx * dx + dy * dy + 1e-12);
  const double ahead = sharpness * (dx * a.cos_theta + dy * a.sin_theta);
  const double blur = 1.0 / (1.0 + std::abs(ahead));
  const double sign = ahead * blur;
  motion.v = distance * sign * inverse_dt;
  motion.omega = toolkit::wrap(b.theta - a.theta) * inverse_dt;
  if constexpr (with_derivatives) {
    const double by_distance = sign * inverse_dt / distance;
    const double by_ahead = distance * sharpness * blur * blur * inverse_dt;
    const double by_x = by_distance * dx + by_ahead * a.cos_theta;
    const double by_y = by_distance * dy + by_ahead * a.sin_theta;
    motion.v_by = {-by_x, -by_y, by_ahead * (dy * a.cos_theta - dx * a.sin_theta), -motion.v * inverse_dt, by_x,
                   by_y,  0.0};
    motion.omega_by = {0.0, 0.0, -inverse_dt, -motion.omega * inverse_dt, 0.0, 0.0, inverse_dt};
  }
}

// A residual over a block of variables.
template <std::size_t size>
struct Residual {
  double error = 0.0;
  std::array<double, size> by = {};
};

// Both poses lie on one arc: the chord is in the direction of the mean heading.
inline Residual<pair_block> non_holonomic(const DirectedPose& a, const DirectedPose& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double c = a.cos_theta + b.cos_theta;
  const double s = a.sin_theta + b.sin_theta;
  return {c * dy - s * dx,
          {s, -c, -a.sin_theta * dy - a.cos_theta * dx, 0.0, -s, c, -b.sin_theta * dy - b.cos_theta * dx}};
}

// Positive for a way that leads forward as seen from the first pose: the projection, to be kept above 0.
inline Residual<pair_block> forward(const DirectedPose& a, const DirectedPose& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return {dx * a.cos_theta + dy * a.sin_theta,
          {-a.cos_theta, -a.sin_theta, dy * a.cos_theta - dx * a.sin_theta, 0.0, a.cos_theta, a.sin_theta, 0.0}};
}

// How far apart two poses lie.
inline Residual<pair_block> length(const DirectedPose& a, const DirectedPose& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double distance = std::sqrt(dx * dx + dy * dy + 1e-12);
  return {distance, {-dx / distance, -dy / distance, 0.0, 0.0, dx / distance, dy / distance, 0.0}};
}

// The change from one interval's velocity to the next one's: 2 (second - first) / (dt_first + dt_second).
// `first_by`, `second_by`: the velocities' own derivatives.
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

// The change from a velocity given at the start to the first interval's (or, with direction -1, from the last
// interval's to one given at the goal), within that interval.
inline Residual<pair_block> end_acceleration(double given, double velocity, const std::array<double, pair_block>& by,
                                             double dt_s, double direction) {
  Residual<pair_block> result;
  result.error = direction * (velocity - given) / dt_s;
  for (std::size_t i = 0; i < pair_block; ++i) result.by[i] = direction * by[i] / dt_s;
  result.by[3] -= result.error / dt_s;
  return result;
}

}  // namespace dmrp::controllers::teb

#endif
