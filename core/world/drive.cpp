// SPDX-License-Identifier: MIT
#include "core/world/drive.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "core/world/motion_limits.hpp"
#include "core/world/unicycle.hpp"

namespace dmrp::core {
namespace {

constexpr double steering_speed = 1e-9;  // m/s; slower commands do not determine a steering angle

// Nodes and weights of Gauss-Legendre quadrature on [0, 1], order 10.
constexpr std::array<double, 5> nodes = {0.046910077030668004, 0.230765344947158454, 0.5, 0.769234655052841546,
                                         0.953089922969331996};
constexpr std::array<double, 5> weights = {0.118463442528094544, 0.239314335249683234, 0.284444444444444444,
                                           0.239314335249683234, 0.118463442528094544};

double steering_of(const dmrp_twist& command, const dmrp_limits& limits) {
  return std::atan(command.omega * limits.wheelbase_m / command.v_x);
}

// Along the curve that the robot describes while its wheels turn at a constant rate.
dmrp_pose steer(const dmrp_pose& pose, double v_x, double from_rad, double to_rad, double duration_s,
                double wheelbase_m) {
  const double rate = (to_rad - from_rad) / duration_s;
  const auto turned = [&](double t_s) {  // the integral of v_x tan(steering) / wheelbase_m
    const double now_rad = from_rad + rate * t_s;
    return v_x / (wheelbase_m * rate) * std::log(std::cos(from_rad) / std::cos(now_rad));
  };
  dmrp_pose end = pose;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double heading = pose.theta + turned(nodes[i] * duration_s);
    end.x += weights[i] * duration_s * v_x * std::cos(heading);
    end.y += weights[i] * duration_s * v_x * std::sin(heading);
  }
  end.theta = toolkit::wrap(pose.theta + turned(duration_s));
  return end;
}

DriveState advance_ackermann(const DriveState& state, const dmrp_twist& command, const dmrp_limits& limits,
                             double dt_s) {
  const bool is_standing = std::abs(command.v_x) < steering_speed;
  const double aim_rad = is_standing ? state.steering_rad : steering_of(command, limits);
  const double change_rad = aim_rad - state.steering_rad;
  DriveState next = state;
  next.velocity = track({state.velocity.v_x, 0.0, 0.0}, {command.v_x, 0.0, 0.0}, limits, dt_s);
  const double steering_s = std::min(dt_s, std::abs(change_rad) / limits.steering_rate_max);
  if (steering_s > 0.0) {
    next.steering_rad =
        steering_s < dt_s ? aim_rad : state.steering_rad + std::copysign(limits.steering_rate_max * dt_s, change_rad);
    next.pose =
        steer(state.pose, next.velocity.v_x, state.steering_rad, next.steering_rad, steering_s, limits.wheelbase_m);
  }
  next.velocity.omega = next.velocity.v_x * std::tan(next.steering_rad) / limits.wheelbase_m;
  if (steering_s < dt_s) next.pose = move(next.pose, next.velocity, dt_s - steering_s);
  return next;
}

dmrp_twist track_holonomic(const dmrp_twist& velocity, const dmrp_twist& command, const dmrp_limits& limits,
                           double dt_s) {
  const double change_x = command.v_x - velocity.v_x;
  const double change_y = command.v_y - velocity.v_y;
  const double change = std::hypot(change_x, change_y);
  const double share = std::min(1.0, limits.a_max * dt_s / std::max(change, 1e-300));
  const dmrp_twist turning = track({0.0, 0.0, velocity.omega}, {0.0, 0.0, command.omega}, limits, dt_s);
  return clip_to_limits({velocity.v_x + share * change_x, velocity.v_y + share * change_y, turning.omega}, limits);
}

}  // namespace

dmrp_twist clip_to_drive(const dmrp_twist& command, Drive drive, const dmrp_limits& limits) {
  dmrp_twist clipped = clip_to_limits(command, limits);
  if (drive != Drive::ackermann) return clipped;
  const double sharpest = std::abs(clipped.v_x) * std::tan(limits.steering_max) / limits.wheelbase_m;
  clipped.omega = std::clamp(clipped.omega, -sharpest, sharpest);
  return clipped;
}

DriveState advance(const DriveState& state, const dmrp_twist& command, Drive drive, const dmrp_limits& limits,
                   double dt_s) {
  assert(is_finite(command) && dt_s > 0.0);
  if (drive == Drive::ackermann) return advance_ackermann(state, command, limits, dt_s);
  DriveState next = state;
  next.velocity = drive == Drive::holonomic ? track_holonomic(state.velocity, command, limits, dt_s)
                                            : track(state.velocity, command, limits, dt_s);
  next.pose = move(state.pose, next.velocity, dt_s);
  return next;
}

}  // namespace dmrp::core
