// SPDX-License-Identifier: MIT
#include "controllers/motion/stop_and_rotate.hpp"

#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/drive_ability.hpp"

namespace dmrp::controllers {

namespace {

// The robot latches within this fraction of the goal's tolerance, so that it stops well inside; the second fraction is
// for a robot that cannot come closer.
constexpr double reached_fraction = 0.5;
constexpr double settled_fraction = 0.9;

// Every controller of this folder comes this near to its goal.
constexpr double near_m = 0.1;

// What is left is driven straight, at this speed at most, and up to this fraction of the goal's tolerance.
constexpr double last_speed = 0.1;
constexpr double last_fraction = 0.25;
constexpr double ahead_rad = 0.2;

}  // namespace

double turning_rate(double angle, const Observation& now) {
  const double period_s = seconds(now.dt_ns);
  const double reach = now.limits.alpha_max * period_s;
  const double rate = std::min(now.limits.omega_max, stopping_speed(std::abs(angle), now.limits.alpha_max, period_s));
  const double wanted = std::copysign(rate, angle);
  return std::clamp(toward(now.velocity.omega, wanted, reach), -now.limits.omega_max, now.limits.omega_max);
}

Command braking(const Observation& now) {
  const double period_s = seconds(now.dt_ns);
  const Vec2 slower = toward(Vec2{now.velocity.v_x, now.velocity.v_y}, Vec2{0.0, 0.0}, now.limits.a_max * period_s);
  if (is_car_like(now.limits)) {
    const double v_x = std::clamp(slower.x, now.limits.v_min, now.limits.v_max);
    return steered(v_x, v_x == 0.0 ? 0.0 : now.velocity.omega / now.velocity.v_x, now.limits);
  }
  Command command;
  command.v_x = slower.x;
  command.v_y = slower.y;
  command.omega = toward(now.velocity.omega, 0.0, now.limits.alpha_max * period_s);
  return command;
}

std::optional<Command> braking_turn(double angle, const Observation& now, const FootprintCheck& footprint) {
  constexpr double free_s = 0.5;
  constexpr int steps = 5;
  Command command = braking(now);
  command.omega = turning_rate(angle, now);
  if (footprint.arc_cost(now.pose, 0.0, command.omega, free_s, steps) == in_collision) return {};
  return command;
}

namespace {

double distance_to(const StopPoint& stop, const Observation& now) {
  return toolkit::distance(toolkit::position(now.pose), stop.position);
}

bool asks_for_more(const StopPoint& stop, const Observation& now) {
  return reached_fraction * stop.tolerance_m < near_m && !is_car_like(now.limits);
}

// Straight to the stop point; a differential drive turns to it first.
Command drive_to(const StopPoint& stop, const Observation& now) {
  const double period_s = seconds(now.dt_ns);
  const Vec2 way = toolkit::rotate(stop.position - toolkit::position(now.pose), -now.pose.theta);
  const double speed =
      std::min({last_speed, now.limits.v_max, stopping_speed(toolkit::norm(way), now.limits.a_max, period_s)});
  Command command = braking(now);
  if (now.limits.v_y_max > 0.0) {
    const Vec2 wanted = std::min(speed, now.limits.v_y_max) * toolkit::normalized(way);
    const Vec2 velocity = toward(Vec2{now.velocity.v_x, now.velocity.v_y}, wanted, now.limits.a_max * period_s);
    command.v_x = std::max(velocity.x, now.limits.v_min);
    command.v_y = velocity.y;
    return command;
  }
  const double angle = std::atan2(way.y, way.x);
  command.omega = turning_rate(angle, now);
  if (std::abs(angle) < ahead_rad) command.v_x = toward(now.velocity.v_x, speed, now.limits.a_max * period_s);
  return command;
}

}  // namespace

bool StopAndRotate::reached(const StopPoint& stop, const Observation& now) {
  const double released_m = asks_for_more(stop, now) ? 2.0 * near_m : stop.tolerance_m;
  if (latched_ && (toolkit::distance(latched_at_, stop.position) > 1e-3 || distance_to(stop, now) > released_m))
    reset();
  return latched_ || latch(stop, now, reached_fraction);
}

bool StopAndRotate::arrived(const StopPoint& stop, const Observation& now) {
  if (!reached(stop, now)) return false;
  if (!is_car_like(now.limits) || std::isnan(stop.heading)) return true;
  return std::abs(toolkit::difference(now.pose.theta, stop.heading)) <= stop.tolerance_rad;
}

bool StopAndRotate::settles(const StopPoint& stop, const Observation& now) {
  return latch(stop, now, settled_fraction);
}

bool StopAndRotate::latch(const StopPoint& stop, const Observation& now, double fraction) {
  const double near_enough_m = fraction * stop.tolerance_m;
  latched_ = distance_to(stop, now) <= (asks_for_more(stop, now) ? std::max(near_enough_m, near_m) : near_enough_m);
  latched_at_ = stop.position;
  return latched_;
}

// Comes nearer than needed once it has begun: a turn in place moves the robot a little.
bool StopAndRotate::approaches(const StopPoint& stop, const Observation& now) {
  const double fraction = approaching_ ? last_fraction : reached_fraction;
  approaching_ = asks_for_more(stop, now) && distance_to(stop, now) > fraction * stop.tolerance_m;
  return approaching_;
}

Command StopAndRotate::command(const StopPoint& stop, const Observation& now) {
  if (approaches(stop, now)) {
    turning_ = false;
    return drive_to(stop, now);
  }
  const double angle = std::isnan(stop.heading) ? 0.0 : toolkit::difference(now.pose.theta, stop.heading);
  // stops turning at half the tolerance and starts again only above three quarters of it
  if (std::abs(angle) <= 0.5 * stop.tolerance_rad || std::isnan(stop.heading))
    turning_ = false;
  else if (speed_of(now.velocity) <= stopped_m_s && std::abs(now.velocity.omega) <= stopped_rad_s)
    turning_ = turning_ || std::abs(angle) > 0.75 * stop.tolerance_rad;
  Command command = braking(now);
  if (turning_ && !is_car_like(now.limits)) command.omega = turning_rate(angle, now);
  return command;
}

}  // namespace dmrp::controllers
