// SPDX-License-Identifier: MIT
// unicycle.hpp: exact motion under a constant velocity, and the speeds that a robot can reach and brake from.
#pragma once

#include <algorithm>
#include <cmath>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

// A position and a unit vector for the heading: stepping along an arc and transforming points need no sine.
struct DirectedPoint {
  Vec2 at = {0.0, 0.0};
  Vec2 heading = {1.0, 0.0};
};

inline DirectedPoint directed(Vec2 at, double theta) {
  return {at, {std::cos(theta), std::sin(theta)}};
}
inline DirectedPoint directed(const Pose& pose) {
  return directed({pose.x, pose.y}, pose.theta);
}
inline Pose pose_of(const DirectedPoint& point) {
  return {point.at.x, point.at.y, std::atan2(point.heading.y, point.heading.x)};
}

// Steps of equal duration along the arc of a constant velocity: each moves along the chord and turns by omega dt.
class ArcStepper {
 public:
  ArcStepper(double v, double omega, double dt) : ArcStepper(v, 0.0, omega, dt) {}

  ArcStepper(double v_x, double v_y, double omega, double dt) {
    const double half_turn = 0.5 * omega * dt;
    // sin(x)/x; the series avoids the quotient of two small numbers
    const double sinc =
        std::abs(half_turn) > 1e-4 ? std::sin(half_turn) / half_turn : 1.0 - half_turn * half_turn / 6.0;
    const double chord_x = v_x * dt * sinc;
    const double chord_y = v_y * dt * sinc;
    ahead_ = chord_x * std::cos(half_turn) - chord_y * std::sin(half_turn);
    left_ = chord_x * std::sin(half_turn) + chord_y * std::cos(half_turn);
    cos_turn_ = std::cos(omega * dt);
    sin_turn_ = std::sin(omega * dt);
  }

  void step(DirectedPoint& point) const {
    const auto [c, s] = point.heading;
    point.at.x += c * ahead_ - s * left_;
    point.at.y += s * ahead_ + c * left_;
    point.heading = {c * cos_turn_ - s * sin_turn_, s * cos_turn_ + c * sin_turn_};
  }

 private:
  double ahead_;
  double left_;
  double cos_turn_;
  double sin_turn_;
};

// Moves `current` toward `target` by at most `step`.
inline double toward(double current, double target, double step) {
  return std::clamp(target, current - step, current + step);
}

// Moves the velocity (v_x, v_y) of a holonomic drive toward `target` by at most `step`.
inline Vec2 toward(Vec2 current, Vec2 target, double step) {
  const Vec2 change = target - current;
  if (change.y == 0.0) return {toward(current.x, target.x, step), current.y};
  const double length = toolkit::norm(change);
  return length <= step ? target : current + (step / length) * change;
}

// The speed of translation.
inline double speed_of(const Twist& velocity) {
  return std::hypot(velocity.v_x, velocity.v_y);
}

// Below these a robot has stopped (trans_stopped_vel and rot_stopped_vel upstream).
inline constexpr double stopped_m_s = 0.02;
inline constexpr double stopped_rad_s = 0.02;

// Below these a robot, or somebody whom it sees, counts as standing.
inline constexpr double standing_m_s = 0.05;
inline constexpr double standing_rad_s = 0.05;

inline bool stands(const Twist& velocity) {
  return speed_of(velocity) < standing_m_s && std::abs(velocity.omega) < standing_rad_s;
}

// The highest speed at which the robot still stops within `distance` (metres or radians) if it keeps that speed for one
// control period and then brakes at `deceleration`.
inline double stopping_speed(double distance, double deceleration, double period_s) {
  if (distance <= 0.0) return 0.0;
  const double a = deceleration;
  return a * (std::sqrt(period_s * period_s + 2.0 * distance / a) - period_s);
}

}  // namespace dmrp::controllers
