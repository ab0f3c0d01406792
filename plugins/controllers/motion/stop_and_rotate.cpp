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

// Below these the robot counts as stopped (trans_stopped_vel and rot_stopped_vel upstream).
constexpr double standing_m_s = 0.02;
constexpr double standing_rad_s = 0.02;

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

bool StopAndRotate::reached(const StopPoint& stop, const Observation& now) {
  const double distance_m = toolkit::distance(toolkit::position(now.pose), stop.position);
  if (latched_ && (toolkit::distance(latched_at_, stop.position) > 1e-3 || distance_m > stop.tolerance_m)) reset();
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
  latched_ = toolkit::distance(toolkit::position(now.pose), stop.position) <= fraction * stop.tolerance_m;
  latched_at_ = stop.position;
  return latched_;
}

Command StopAndRotate::command(const StopPoint& stop, const Observation& now) {
  const double angle = std::isnan(stop.heading) ? 0.0 : toolkit::difference(now.pose.theta, stop.heading);
  // stops turning at half the tolerance and starts again only above three quarters of it
  if (std::abs(angle) <= 0.5 * stop.tolerance_rad || std::isnan(stop.heading))
    turning_ = false;
  else if (speed_of(now.velocity) <= standing_m_s && std::abs(now.velocity.omega) <= standing_rad_s)
    turning_ = turning_ || std::abs(angle) > 0.75 * stop.tolerance_rad;
  Command command = braking(now);
  if (turning_ && !is_car_like(now.limits)) command.omega = turning_rate(angle, now);
  return command;
}

}  // namespace dmrp::controllers
