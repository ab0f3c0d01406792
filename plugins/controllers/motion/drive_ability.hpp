// SPDX-License-Identifier: MIT
// drive_ability.hpp: what the drives other than differential can and cannot do, from a robot's limits.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

inline bool is_holonomic(const Limits& limits) {
  return limits.v_y_max > 0.0;
}

inline bool is_car_like(const Limits& limits) {
  return limits.wheelbase_m > 0.0;
}

// Of a car-like drive: the curvature of its tightest arc, and of the arc at a steering angle (1/m).
inline double sharpest_curvature(const Limits& limits) {
  assert(is_car_like(limits));
  return std::tan(limits.steering_max) / limits.wheelbase_m;
}
inline double curvature_at(double steering_rad, const Limits& limits) {
  assert(is_car_like(limits));
  return std::tan(steering_rad) / limits.wheelbase_m;
}

// The command of a car-like drive at this speed that comes nearest to a curvature.
inline Command steered(double v_x, double curvature, const Limits& limits) {
  const double sharpest = sharpest_curvature(limits);
  Command command;
  command.v_x = v_x;
  command.omega = std::clamp(v_x * std::clamp(curvature, -sharpest, sharpest), -limits.omega_max, limits.omega_max);
  return command;
}

// For a car-like drive, instead of a turn in place: the arc of this radius from a pose until it faces a point within
// `within_rad`, at most one turn. Calls visit(pose, length_m) for poses along it, with the length of arc before each.
template <class Visit>
void face_by_arc(const Pose& from, Vec2 to, double radius_m, double within_rad, Visit&& visit) {
  constexpr double step_rad = 0.3;
  Pose at = from;
  const double side = toolkit::difference(at.theta, toolkit::bearing(at, to)) < 0.0 ? -1.0 : 1.0;
  for (double turned_rad = 0.0; turned_rad < 2.0 * toolkit::pi; turned_rad += step_rad) {
    if (std::abs(toolkit::difference(at.theta, toolkit::bearing(at, to))) < within_rad) return;
    DirectedPoint next = directed(at);
    ArcStepper(radius_m * step_rad, side * step_rad, 1.0).step(next);
    at = {next.at.x, next.at.y, at.theta + side * step_rad};
    visit(at, radius_m * step_rad);
  }
}

// The steering angle of a car-like drive, which observations do not show while it stands.
class SteeringEstimate {
 public:
  void reset() { angle_rad_ = 0.0; }

  // Once per control period.
  void update(const Observation& now) {
    if (!is_car_like(now.limits) || std::abs(now.velocity.v_x) < stopped_m_s) return;
    const double angle_rad = std::atan(now.velocity.omega * now.limits.wheelbase_m / now.velocity.v_x);
    angle_rad_ = std::clamp(angle_rad, -now.limits.steering_max, now.limits.steering_max);
  }

  double angle_rad() const { return angle_rad_; }

  // Turns the wheels toward the angle of a command for one period. Returns the mean curvature in it.
  double turn_toward(const Command& command, const Limits& limits, double period_s) {
    if (command.v_x == 0.0) return curvature_at(angle_rad_, limits);
    const double aim_rad = std::atan(command.omega * limits.wheelbase_m / command.v_x);
    const double before_rad = angle_rad_;
    angle_rad_ = toward(angle_rad_, aim_rad, limits.steering_rate_max * period_s);
    return curvature_at(0.5 * (before_rad + angle_rad_), limits);
  }

 private:
  double angle_rad_ = 0.0;
};

// The velocity one period later if the robot brakes; `v` is its velocity now. A car-like drive keeps its curvature.
inline Twist braked(const Twist& v, const Limits& limits, double period_s) {
  const auto slower = [period_s](double speed, double deceleration) {
    return toward(0.0, speed, std::max(0.0, std::abs(speed) - deceleration * period_s));
  };
  Twist next = v;
  if (is_holonomic(limits)) {
    const Vec2 left = toward(Vec2{v.v_x, v.v_y}, Vec2{0.0, 0.0}, limits.a_max * period_s);
    next.v_x = left.x;
    next.v_y = left.y;
  } else {
    next.v_x = slower(v.v_x, limits.a_max);
  }
  if (!is_car_like(limits))
    next.omega = slower(v.omega, limits.alpha_max);
  else
    next.omega = v.v_x == 0.0 ? 0.0 : v.omega * next.v_x / v.v_x;
  return next;
}

}  // namespace dmrp::controllers
