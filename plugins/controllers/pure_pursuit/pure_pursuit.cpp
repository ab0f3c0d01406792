// SPDX-License-Identifier: MIT
#include "controllers/pure_pursuit/pure_pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers {

Descriptor PurePursuit::describe() {
  return describe_controller("dmrp.controller.pure_pursuit", "Pure pursuit")
      .summary("steers along arcs to a point ahead on the path, slower in curves, near obstacles and at the end")
      .source(
          "Macenski, Singh, Martin, Gines: Regulated pure pursuit for robot path tracking, Autonomous Robots 47 "
          "(2023)")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC |
                  1u << DMRP_KINEMATICS_ACKERMANN)
      .uses(DMRP_EXT_LOCAL_COSTMAP)
      .uses(DMRP_EXT_ANNOTATE);
}

Status PurePursuit::start(const Start& start) {
  kinematics_ = start.world.robots()[static_cast<std::uint32_t>(start.robot)].kinematics;
  costmap_ = find_extension<dmrp_local_costmap>();
  begin(start);
  return Status::ok;
}

Status PurePursuit::control(const Observation& now, Command& command) {
  if (at_goal_.reached(tracker_.stop(), now)) {
    if (!has_drive(DMRP_KINEMATICS_ACKERMANN)) command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  const dmrp_costmap* map = costmap_ ? costmap_->costmap(costmap_, now.robot) : nullptr;
  command = pursue(now, look_ahead(now), map);
  bool blocked = use_collision_detection && map && is_blocked(now, command, map);
  if (blocked) {
    // a shorter look-ahead cuts the corner less; the published controller would stop here for good
    command = pursue(now, min_lookahead_dist, map);
    blocked = is_blocked(now, command, map);
  }
  if (!blocked) {
    annotations_.arc(now.pose, command, max_allowed_time_to_collision_up_to_carrot);
    return Status::ok;
  }
  command = braking(now);
  // a robot that stands before an obstacle waits: that is not a failure to find a command
  if (now.velocity.v_x == 0.0 && now.velocity.v_y == 0.0 && now.velocity.omega == 0.0) return Status::ok;
  set_error("the arc to the look-ahead point runs into an obstacle");
  return Status::no_solution;
}

double PurePursuit::look_ahead(const Observation& now) const {
  if (!use_velocity_scaled_lookahead_dist) return lookahead_dist;
  return std::max<double>(min_lookahead_dist,
                          std::min<double>(speed_of(now.velocity) * lookahead_time, max_lookahead_dist));
}

Command PurePursuit::pursue(const Observation& now, double look_ahead_m, const dmrp_costmap* map) const {
  const double period_s = seconds(now.dt_ns);
  const Vec2 carrot =
      toolkit::to_local(now.pose, tracker_.point_at_distance(toolkit::position(now.pose), look_ahead_m));
  if (has_drive(DMRP_KINEMATICS_HOLONOMIC)) return translate(now, carrot, map);
  const bool is_car = has_drive(DMRP_KINEMATICS_ACKERMANN);
  const double angle = std::atan2(carrot.y, carrot.x);
  if (!is_car && std::abs(angle) > (use_rotate_to_heading ? *rotate_to_heading_min_angle : toolkit::pi / 2))
    return turn_in_place(now, angle);
  const double step_m_s = now.limits.a_max * period_s;
  const double squared = toolkit::squared_norm(carrot);
  double curvature = squared > 1e-6 ? 2.0 * carrot.y / squared : 0.0;
  if (is_car) {
    const double sharpest = std::tan(now.limits.steering_max) / now.limits.wheelbase_m;
    // the arc to a point behind gets flatter, the nearer it is to straight behind
    if (std::abs(angle) > toolkit::pi / 2) curvature = std::copysign(sharpest, carrot.y);
    curvature = std::clamp(curvature, -sharpest, sharpest);
  }
  Command command;
  double speed = std::min(regulated_speed(now, curvature, map), approach_speed(now));
  if (std::abs(curvature) > 1e-9) speed = std::min(speed, now.limits.omega_max / std::abs(curvature));
  command.v_x = std::clamp(toward(now.velocity.v_x, speed, step_m_s), 0.0, now.limits.v_max);
  const double wanted = command.v_x * curvature;
  const double omega = is_car ? wanted : toward(now.velocity.omega, wanted, now.limits.alpha_max * period_s);
  command.omega = std::clamp(omega, -now.limits.omega_max, now.limits.omega_max);
  return command;
}

Command PurePursuit::turn_in_place(const Observation& now, double angle) const {
  Command command = braking(now);
  command.omega = turning_rate(angle, now);
  return command;
}

Command PurePursuit::translate(const Observation& now, Vec2 carrot, const dmrp_costmap* map) const {
  const double distance_m = toolkit::norm(carrot);
  if (distance_m < 1e-6) return braking(now);
  const Vec2 ahead = carrot / distance_m;
  double speed = std::min(regulated_speed(now, 0.0, map), approach_speed(now));
  if (std::abs(ahead.y) > 1e-9) speed = std::min(speed, now.limits.v_y_max / std::abs(ahead.y));
  if (ahead.x < 0.0) speed = std::min(speed, -now.limits.v_min / -ahead.x);
  const Vec2 velocity = {now.velocity.v_x, now.velocity.v_y};
  const Vec2 change = speed * ahead - velocity;
  const double most = now.limits.a_max * seconds(now.dt_ns);
  const Vec2 reached = velocity + change * std::min(1.0, most / std::max(toolkit::norm(change), 1e-9));
  Command command;
  command.v_x = reached.x;
  command.v_y = reached.y;
  command.omega = turning_rate(std::atan2(carrot.y, carrot.x), now);
  return command;
}

double PurePursuit::regulated_speed(const Observation& now, double curvature, const dmrp_costmap* map) const {
  double speed = now.limits.v_max;
  if (use_regulated_linear_velocity_scaling) {
    const double radius_m = 1.0 / std::max(std::abs(curvature), 1e-9);
    speed = std::min(speed, now.limits.v_max * radius_m / regulated_linear_scaling_min_radius);
  }
  if (use_cost_regulated_linear_velocity_scaling && map) {
    const CostmapView view(*map);
    const std::uint8_t cost = view.cost(toolkit::position(now.pose));
    const double distance_m = view.distance_of(cost);
    if (cost != DMRP_COST_FREE && distance_m < cost_scaling_dist)
      speed = std::min(speed, now.limits.v_max * cost_scaling_gain * distance_m / cost_scaling_dist);
  }
  return std::clamp<double>(speed, std::min<double>(regulated_linear_scaling_min_speed, now.limits.v_max),
                            now.limits.v_max);
}

double PurePursuit::approach_speed(const Observation& now) const {
  const double along_m = tracker_.remaining_m();
  const double straight_m = toolkit::distance(toolkit::position(now.pose), tracker_.stop().position);
  const double remaining_m = std::max(along_m, straight_m);
  const double in_time = stopping_speed(remaining_m, now.limits.a_max, seconds(now.dt_ns));
  if (remaining_m >= approach_velocity_scaling_dist) return std::min(now.limits.v_max, in_time);
  const double scaled = now.limits.v_max * remaining_m / approach_velocity_scaling_dist;
  return std::min(std::max<double>(scaled, min_approach_linear_velocity), in_time);
}

// Checks the arc up to the look-ahead point, bounded by the time allowed, and at least for the braking time.
bool PurePursuit::is_blocked(const Observation& now, const Command& command, const dmrp_costmap* map) const {
  const CostmapView view(*map);
  const FootprintCheck check(view, now.footprint, footprint_padding, now.pose);
  const double speed = std::hypot(command.v_x, command.v_y);
  double duration_s = max_allowed_time_to_collision_up_to_carrot;
  if (speed > 1e-3) {
    const double braking_s = speed / now.limits.a_max + seconds(now.dt_ns);
    duration_s = std::max(std::min(duration_s, look_ahead(now) / speed), braking_s);
  }
  const double length_m = std::max(speed, std::abs(command.omega) * now.footprint.radius_m) * duration_s;
  const int steps = 1 + static_cast<int>(length_m / view.resolution_m());
  if (!has_drive(DMRP_KINEMATICS_HOLONOMIC))
    return check.arc_cost(now.pose, command.v_x, command.omega, duration_s, steps) == in_collision;
  for (int i = 1; i <= steps; ++i) {
    const Vec2 way = Vec2{command.v_x, command.v_y} * (duration_s * i / steps);
    if (check.cost(directed(toolkit::to_world(now.pose, way), now.pose.theta)) == in_collision) return true;
  }
  return false;
}

}  // namespace dmrp::controllers
