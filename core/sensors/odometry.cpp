// SPDX-License-Identifier: MIT
#include "core/sensors/odometry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>

namespace dmrp::core {
namespace {

constexpr double min_distance_m = 1e-9;  // a shorter motion has no direction

// A motion in the terms of the model.
struct Motion {
  double turn_before = 0.0;  // rot1, at most 90 degrees: driving backwards is a negative distance
  double distance_m = 0.0;
  double turn_after = 0.0;
};

Motion motion_between(const dmrp_pose& from, const dmrp_pose& to) {
  Motion motion;
  const dmrp_vec2 way = toolkit::position(to) - toolkit::position(from);
  motion.distance_m = toolkit::norm(way);
  if (motion.distance_m > min_distance_m) {
    motion.turn_before = toolkit::difference(from.theta, std::atan2(way.y, way.x));
    if (std::abs(motion.turn_before) > 0.5 * std::numbers::pi) {
      motion.turn_before = toolkit::wrap(motion.turn_before + std::numbers::pi);
      motion.distance_m = -motion.distance_m;
    }
  }
  motion.turn_after = toolkit::wrap(toolkit::difference(from.theta, to.theta) - motion.turn_before);
  return motion;
}

}  // namespace

Odometry::Odometry(const OdometrySettings& settings, std::uint64_t seed, std::uint32_t robot, const dmrp_pose& pose,
                   Drive drive)
    : settings_(settings), seed_(seed), robot_(robot), drive_(drive), truth_(pose), estimate_(pose) {}

bool Odometry::is_exact() const {
  return std::all_of(settings_.noise.begin(), settings_.noise.end(), [](double a) { return a == 0.0; });
}

void Odometry::read(std::int64_t t_ns, const dmrp_pose& pose, const dmrp_twist& velocity) {
  assert(t_ns > read_ns_);
  const dmrp_pose before = truth_;
  const std::int64_t since_ns = t_ns - read_ns_;
  const bool is_first = read_ns_ < 0;
  truth_ = pose;
  read_ns_ = t_ns;
  velocity_ = velocity;
  if (is_exact() || is_first) {
    estimate_ = pose;
    return;
  }

  toolkit::Stream noise(seed_, "odometry", robot_, t_ns);
  const double per_second = 1e9 / static_cast<double>(since_ns);
  if (drive_ == Drive::holonomic)
    add_omnidirectional_errors(before, noise, per_second);
  else
    add_rolling_errors(before, noise, per_second);

  if (settings_.fix_period_ns > 0 && t_ns - fixed_ns_ >= settings_.fix_period_ns) {
    estimate_ = pose;
    fixed_ns_ = t_ns;
  }
}

// From `before` to truth_.
void Odometry::add_rolling_errors(const dmrp_pose& before, toolkit::Stream& noise, double per_second) {
  const auto [a1, a2, a3, a4] = settings_.noise;
  const Motion truth = motion_between(before, truth_);
  const double distance2 = truth.distance_m * truth.distance_m;
  const double before2 = truth.turn_before * truth.turn_before;
  const double after2 = truth.turn_after * truth.turn_after;
  const double before_error = noise.normal(0.0, std::sqrt(a1 * before2 + a2 * distance2));
  const double distance_error_m = noise.normal(0.0, std::sqrt(a3 * distance2 + a4 * (before2 + after2)));
  const double after_error = noise.normal(0.0, std::sqrt(a1 * after2 + a2 * distance2));

  const double heading = estimate_.theta + truth.turn_before + before_error;
  estimate_.x += (truth.distance_m + distance_error_m) * std::cos(heading);
  estimate_.y += (truth.distance_m + distance_error_m) * std::sin(heading);
  estimate_.theta = toolkit::wrap(heading + truth.turn_after + after_error);
  velocity_.v_x += distance_error_m * per_second;
  velocity_.omega += (before_error + after_error) * per_second;
}

void Odometry::add_omnidirectional_errors(const dmrp_pose& before, toolkit::Stream& noise, double per_second) {
  const auto [a1, a2, a3, a4] = settings_.noise;
  const dmrp_vec2 way = toolkit::to_local(before, toolkit::position(truth_));
  const double turn = toolkit::difference(before.theta, truth_.theta);
  const double distance2 = toolkit::squared_norm(way);
  const double component_sd_m = std::sqrt(a3 * distance2 + a4 * turn * turn);
  const double turn_error = noise.normal(0.0, std::sqrt(a1 * turn * turn + a2 * distance2));
  const double x_error_m = noise.normal(0.0, component_sd_m);
  const double y_error_m = noise.normal(0.0, component_sd_m);

  const dmrp_vec2 there = toolkit::to_world(estimate_, way + dmrp_vec2{x_error_m, y_error_m});
  estimate_ = {there.x, there.y, toolkit::wrap(estimate_.theta + turn + turn_error)};
  velocity_.v_x += x_error_m * per_second;
  velocity_.v_y += y_error_m * per_second;
  velocity_.omega += turn_error * per_second;
}

double Odometry::heading_error() const {
  return toolkit::difference(truth_.theta, estimate_.theta);
}

dmrp_vec2 Odometry::direction_to_estimated(dmrp_vec2 direction) const {
  return is_exact() ? direction : toolkit::rotate(direction, heading_error());
}

dmrp_pose Odometry::to_estimated(const dmrp_pose& pose) const {
  if (is_exact()) return pose;
  const dmrp_vec2 seen = toolkit::position(pose) - toolkit::position(truth_);
  const dmrp_vec2 there = toolkit::position(estimate_) + toolkit::rotate(seen, heading_error());
  return {there.x, there.y, toolkit::wrap(pose.theta + heading_error())};
}

}  // namespace dmrp::core
