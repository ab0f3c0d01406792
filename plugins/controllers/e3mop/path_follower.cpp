// SPDX-License-Identifier: MIT
#include "controllers/e3mop/path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "controllers/e3mop/velocity_profile.hpp"
#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers::e3mop {

namespace {

// omega = v k - heading_gain * heading error - cross_gain * v * cross-track error: both errors decay within a second.
constexpr double heading_gain = 2.0;  // 1/s
constexpr double cross_gain = 3.0;    // 1/m^2

// The curvature is averaged over this length ahead: the robot's turning rate follows with a delay.
constexpr double curvature_reach_m = 0.3;

// The speed decreases with the heading error, to 0 at this error.
constexpr double standstill_rad = 1.0;

}  // namespace

TrackingError tracking_error(const std::vector<PathPoint>& path, const Pose& pose) {
  TrackingError error;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double squared = toolkit::squared_distance(toolkit::position(pose), path[i].at);
    if (squared >= nearest) continue;
    nearest = squared;
    error.index = i;
  }
  const PathPoint& reference = path[error.index];
  error.cross_m = toolkit::cross(toolkit::from_angle(reference.theta), toolkit::position(pose) - reference.at);
  error.heading_rad = toolkit::difference(reference.theta, pose.theta);
  return error;
}

Command follow(const std::vector<PathPoint>& path, const Observation& now) {
  const double period_s = seconds(now.dt_ns);
  DirectedPoint at = directed(now.pose);
  ArcStepper(now.velocity.v_x, now.velocity.omega, period_s).step(at);
  const TrackingError error = tracking_error(path, pose_of(at));
  const PathPoint& reference = path[error.index];
  std::size_t beyond = error.index;
  while (beyond + 1 < path.size() && path[beyond].arc_m < reference.arc_m + curvature_reach_m) ++beyond;
  const double span_m = path[beyond].arc_m - reference.arc_m;
  const double curvature = span_m > 0.0 ? toolkit::difference(reference.theta, path[beyond].theta) / span_m : 0.0;

  Command command;
  const double slowdown = std::clamp(1.0 - std::abs(error.heading_rad) / standstill_rad, 0.0, 1.0);
  const double speed = std::clamp(slowdown * speed_after(path, period_s), 0.0, now.limits.v_max);
  command.v_x = std::clamp(toward(now.velocity.v_x, speed, now.limits.a_max * period_s), 0.0, now.limits.v_max);
  const double omega =
      command.v_x * curvature - heading_gain * error.heading_rad - cross_gain * command.v_x * error.cross_m;
  command.omega = std::clamp(toward(now.velocity.omega, omega, now.limits.alpha_max * period_s), -now.limits.omega_max,
                             now.limits.omega_max);
  return command;
}

}  // namespace dmrp::controllers::e3mop
