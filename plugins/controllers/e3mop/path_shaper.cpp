// SPDX-License-Identifier: MIT
#include "controllers/e3mop/path_shaper.hpp"

#include <algorithm>

#include "controllers/e3mop/velocity_profile.hpp"

namespace dmrp::controllers::e3mop {

namespace {

constexpr double spline_step_m = 0.05;

// Within this distance of the goal the path is straight.
constexpr double last_leg_m = 0.5;

// A smoothed path must be free for the braking distance and this much more.
constexpr double least_free_m = 0.3;

}  // namespace

bool PathShaper::shape(const RoughPath& rough, const Observation& now, const ClearanceField& field,
                       const FreeSpace& free_space, const ShapeSettings& settings, std::vector<PathPoint>& path) {
  if (lay_last_leg(rough, settings.point_spacing_m) && fit(now, free_space, {}, 2.0 * last_leg_m, path)) return true;
  const std::optional<double> start_theta = smooth(rough, now, field, free_space, settings);
  const double braking_m = now.velocity.v_x * now.velocity.v_x / (2.0 * now.limits.a_max);
  if (fit(now, free_space, start_theta, braking_m + least_free_m, path)) return true;
  points_ = rough.points;
  return fit(now, free_space, start_theta, 0.0, path);
}

// The last half metre, straight to the goal: smoothing would bend so short a path away from obstacles beside it.
bool PathShaper::lay_last_leg(const RoughPath& rough, double spacing_m) {
  if (!rough.path_end) return false;
  const Vec2 from = rough.points[rough.kept - 1];
  const Vec2 goal = *rough.path_end;
  const double left_m = toolkit::distance(from, goal);
  if (left_m > last_leg_m || left_m < 1e-3) return false;
  points_.assign(rough.points.begin(), rough.points.begin() + static_cast<std::ptrdiff_t>(rough.kept));
  const auto steps = std::max(1, static_cast<int>(left_m / spacing_m));
  for (int i = 1; i <= steps; ++i) points_.push_back(toolkit::lerp(from, goal, static_cast<double>(i) / steps));
  return true;
}

// Smooths the points; returns the direction in which the spline has to start, if it is given.
std::optional<double> PathShaper::smooth(const RoughPath& rough, const Observation& now, const ClearanceField& field,
                                         const FreeSpace& free_space, const ShapeSettings& settings) {
  points_ = rough.points;
  std::size_t fixed = rough.kept;
  std::optional<double> start_theta = rough.start_theta;
  if (rough.kept == 1 && now.velocity.v_x < slow_m_s) {
    start_theta.reset();
  } else if (rough.kept == 1 && points_.size() > 3) {
    points_[1] = points_[0] + settings.point_spacing_m * toolkit::from_angle(rough.start_theta);
    fixed = 2;
  }
  SmoothingSettings smoothing = settings.smoothing;
  smoothing.needed_m = free_space.needed_m();
  smoother_.smooth(points_, fixed, field, smoothing);
  return start_theta;
}

// The spline and its speeds, up to the first collision. False if that is closer than `needed_m`.
bool PathShaper::fit(const Observation& now, const FreeSpace& free_space, std::optional<double> start_theta,
                     double needed_m, std::vector<PathPoint>& path) {
  spline_.fit(points_, start_theta, spline_step_m, path);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const PathPoint& point = path[i];
    if (free_space.is_free(directed(point.at, point.theta))) continue;
    if (point.arc_m < needed_m) return false;
    path.resize(i);
    break;
  }
  if (path.size() < 2) return false;
  plan_speeds(path, now.velocity.v_x, 0.0, now.limits);
  return true;
}

}  // namespace dmrp::controllers::e3mop
