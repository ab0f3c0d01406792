// SPDX-License-Identifier: MIT
#include "core/sensors/odometry.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>

namespace dmrp::core {
namespace {

constexpr double shortest_way_m = 1e-9;  // has no direction

// A motion as odometry reads it.
struct Reading {
  double turn_before = 0.0;  // rot1, at most a right angle: a robot that drives backward goes a negative way
  double way_m = 0.0;
  double turn_after = 0.0;
};

Reading reading_between(const dmrp_pose& from, const dmrp_pose& to) {
  Reading reading;
  const dmrp_vec2 way = toolkit::position(to) - toolkit::position(from);
  reading.way_m = toolkit::norm(way);
  if (reading.way_m > shortest_way_m) {
    reading.turn_before = toolkit::difference(from.theta, std::atan2(way.y, way.x));
    if (std::abs(reading.turn_before) > 0.5 * std::numbers::pi) {
      reading.turn_before = toolkit::wrap(reading.turn_before + std::numbers::pi);
      reading.way_m = -reading.way_m;
    }
  }
  reading.turn_after = toolkit::wrap(toolkit::difference(from.theta, to.theta) - reading.turn_before);
  return reading;
}

}  // namespace

Odometry::Odometry(const OdometrySettings& settings, std::uint64_t seed, std::uint32_t robot, const dmrp_pose& pose)
    : settings_(settings), seed_(seed), robot_(robot), true_(pose), believed_(pose) {}

bool Odometry::is_exact() const {
  return std::all_of(settings_.noise.begin(), settings_.noise.end(), [](double a) { return a == 0.0; });
}

void Odometry::read(std::int64_t t_ns, const dmrp_pose& pose, const dmrp_twist& velocity) {
  const dmrp_pose before = true_;
  const std::int64_t since_ns = t_ns - read_ns_;
  const bool is_first = read_ns_ < 0;
  true_ = pose;
  read_ns_ = t_ns;
  velocity_ = velocity;
  if (is_exact() || is_first) {
    believed_ = pose;
    return;
  }

  const auto [a1, a2, a3, a4] = settings_.noise;
  const Reading truth = reading_between(before, pose);
  const double way2 = truth.way_m * truth.way_m;
  const double before2 = truth.turn_before * truth.turn_before;
  const double after2 = truth.turn_after * truth.turn_after;
  toolkit::Stream noise(seed_, "odometry", robot_, t_ns);
  const double before_error = noise.normal(0.0, std::sqrt(a1 * before2 + a2 * way2));
  const double way_error_m = noise.normal(0.0, std::sqrt(a3 * way2 + a4 * (before2 + after2)));
  const double after_error = noise.normal(0.0, std::sqrt(a1 * after2 + a2 * way2));

  const double heading = believed_.theta + truth.turn_before + before_error;
  believed_.x += (truth.way_m + way_error_m) * std::cos(heading);
  believed_.y += (truth.way_m + way_error_m) * std::sin(heading);
  believed_.theta = toolkit::wrap(heading + truth.turn_after + after_error);
  const double per_second = 1e9 / static_cast<double>(since_ns);
  velocity_.v_x += way_error_m * per_second;
  velocity_.omega += (before_error + after_error) * per_second;

  if (settings_.fix_period_ns > 0 && t_ns - fixed_ns_ >= settings_.fix_period_ns) {
    believed_ = pose;
    fixed_ns_ = t_ns;
  }
}

double Odometry::turned_by() const {
  return toolkit::difference(true_.theta, believed_.theta);
}

dmrp_vec2 Odometry::direction_as_believed(dmrp_vec2 direction) const {
  return is_exact() ? direction : toolkit::rotate(direction, turned_by());
}

dmrp_pose Odometry::as_believed(const dmrp_pose& pose) const {
  if (is_exact()) return pose;
  const dmrp_vec2 seen = toolkit::position(pose) - toolkit::position(true_);
  const dmrp_vec2 there = toolkit::position(believed_) + toolkit::rotate(seen, turned_by());
  return {there.x, there.y, toolkit::wrap(pose.theta + turned_by())};
}

}  // namespace dmrp::core
