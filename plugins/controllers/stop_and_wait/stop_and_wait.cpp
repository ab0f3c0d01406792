// SPDX-License-Identifier: MIT
#include "controllers/stop_and_wait/stop_and_wait.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/polyline.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "controllers/motion/unicycle.hpp"

namespace dmrp::controllers {

namespace {

// A leg ends where the path turns by more than this; smaller bends are steered.
constexpr double corner_rad = 0.3;

// The next leg begins when the robot is this close to the corner.
constexpr double at_corner_m = 0.05;

// The robot steers to the point of its leg this far ahead.
constexpr double steer_to_m = 0.4;

// It turns in place if that point is farther aside than the first angle, until it is nearer than the second.
constexpr double turn_begin_rad = 0.3;
constexpr double turn_end_rad = 0.05;

// The turn that must be free before the robot begins it.
constexpr double turn_check_s = 0.5;
constexpr int turn_check_steps = 5;

// Nearer than stop_distance, the robot creeps up to another robot, as far as this. Robots that rotate around a cycle of
// cells must all begin while each is still in the way of the next. Between cells of 1 m, robots of 0.25 m radius pass
// each other by 0.2 m.
constexpr double creep_speed = 0.1;
constexpr double robot_distance_m = 0.05;

// Whether nobody but robots is near enough to stand in the way of this robot at a point of its path.
bool only_robots_near(const Observation& now, Vec2 point) {
  constexpr double cells_m = 0.2;  // the padding, and cells and steps of 0.05 m
  bool robots = false;
  for (const Agent& agent : now.agents) {
    if (toolkit::distance(toolkit::position(agent.pose), point) > now.footprint.radius_m + agent.radius_m + cells_m)
      continue;
    if (agent.kind != DMRP_AGENT_ROBOT) return false;
    robots = true;
  }
  return robots;
}

}  // namespace

Descriptor StopAndWait::describe() {
  return describe_controller("dmrp.controller.stop_and_wait", "Stop and wait")
      .summary("drives straight along the path and brakes for anything ahead: the lower bound of local controllers")
      .source("a baseline without a publication")
      .kinematics(1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC)
      .needs(DMRP_EXT_LOCAL_COSTMAP)
      .uses(DMRP_EXT_ANNOTATE);
}

Status StopAndWait::start(const Start& start) {
  costmap_ = &extension<dmrp_local_costmap>();
  begin(start);
  corners_m_.clear();
  next_corner_ = 0;
  turning_ = false;
  return Status::ok;
}

void StopAndWait::set_path(Path path, std::uint64_t) {
  tracker_.set_path(path);
  corners_m_.clear();
  next_corner_ = 0;
  double arc_m = 0.0;
  Vec2 along = {0.0, 0.0};  // direction of the last segment
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 segment = toolkit::position(path[i]) - toolkit::position(path[i - 1]);
    if (toolkit::squared_norm(segment) == 0.0) continue;  // a wait
    const double turn = std::atan2(toolkit::cross(along, segment), toolkit::dot(along, segment));
    if (std::abs(turn) > corner_rad) corners_m_.push_back(arc_m);
    arc_m += toolkit::norm(segment);
    along = segment;
  }
}

Status StopAndWait::control(const Observation& now, Command& command) {
  // a path may pass its own end before it ends there
  const bool near_end = tracker_.remaining_m() <= tracker_.stop().tolerance_m;
  if (near_end && at_goal_.reached(tracker_.stop(), now)) {
    turning_ = false;
    command = at_goal_.command(tracker_.stop(), now);
    return Status::ok;
  }
  const CostmapView map(*costmap_->costmap(costmap_, now.robot));
  const FootprintCheck check(map, now.footprint, footprint_padding, now.pose);
  const Leg leg = current_leg();
  const Vec2 aside = toolkit::to_local(now.pose, leg.ahead);
  const double angle = std::atan2(aside.y, aside.x);
  turning_ = std::abs(angle) > (turning_ ? turn_end_rad : turn_begin_rad);
  if (turning_) {
    const double omega = turning_rate(angle, now);
    if (check.arc_cost(now.pose, 0.0, omega, turn_check_s, turn_check_steps) != in_collision) command.omega = omega;
  } else {
    command = drive(now, leg, check);
  }
  annotations_.arc(now.pose, command, 1.0);
  return Status::ok;
}

StopAndWait::Leg StopAndWait::current_leg() {
  const double progress_m = tracker_.progress_m();
  while (next_corner_ < corners_m_.size() && progress_m > corners_m_[next_corner_] - at_corner_m) ++next_corner_;
  const bool has_corner = next_corner_ < corners_m_.size() && corners_m_[next_corner_] < tracker_.end_m();
  Leg leg;
  leg.end_m = has_corner ? corners_m_[next_corner_] : tracker_.end_m();
  const Vec2 end = tracker_.point_at(leg.end_m);
  const double ahead_m = progress_m + steer_to_m;
  leg.ahead = tracker_.point_at(std::min(ahead_m, leg.end_m));
  // near its end, the robot steers to a point on the leg's extension
  if (ahead_m > leg.end_m) {
    const double backward_m = std::max(0.0, leg.end_m - steer_to_m);
    const Vec2 along = toolkit::normalized(end - tracker_.point_at(backward_m));
    leg.ahead = end + (ahead_m - leg.end_m) * along;
  }
  leg.length_m = std::max(leg.end_m - progress_m, 0.0);
  return leg;
}

Command StopAndWait::drive(const Observation& now, const Leg& leg, const FootprintCheck& check) const {
  const Limits& limits = now.limits;
  const double period_s = seconds(now.dt_ns);
  const Vec2 aside = toolkit::to_local(now.pose, leg.ahead);
  const double curvature = 2.0 * aside.y / toolkit::squared_norm(aside);
  const double braking_m = limits.v_max * (0.5 * limits.v_max / limits.a_max + period_s);
  const Way way = look_ahead(now, leg, check, braking_m + stop_distance);
  const bool is_blocked = way.free_m < leg.length_m;
  const double room_m = is_blocked ? std::min(way.free_m - stop_distance, leg.length_m) : leg.length_m;
  double speed = std::min(limits.v_max, stopping_speed(room_m, limits.a_max, period_s));
  if (is_blocked && only_robots_near(now, way.end))
    speed =
        std::max(speed, std::min(creep_speed, stopping_speed(way.free_m - robot_distance_m, limits.a_max, period_s)));
  if (std::abs(curvature) > 1e-9) speed = std::min(speed, limits.omega_max / std::abs(curvature));
  Command command = braking(now);
  command.v_x = std::clamp(toward(now.velocity.v_x, speed, limits.a_max * period_s), 0.0, limits.v_max);
  command.omega = std::clamp(toward(now.velocity.omega, command.v_x * curvature, limits.alpha_max * period_s),
                             -limits.omega_max, limits.omega_max);
  return command;
}

// Looks no farther than `needed_m`.
StopAndWait::Way StopAndWait::look_ahead(const Observation& now, const Leg& leg, const FootprintCheck& check,
                                         double needed_m) const {
  constexpr double spacing_m = 0.05;
  const Vec2 robot = toolkit::position(now.pose);
  const double look_m = std::min(leg.length_m, needed_m);
  for (double at_m = 0.0; at_m < look_m + spacing_m; at_m += spacing_m) {
    // first from where the robot is to the point that it steers to, then along the leg
    const double on_leg_m = std::min(at_m, look_m);
    const Vec2 on_leg = tracker_.point_at(tracker_.progress_m() + on_leg_m);
    const Vec2 on_way = toolkit::lerp(robot, leg.ahead, std::min(1.0, on_leg_m / steer_to_m));
    const Vec2 point = on_leg_m < steer_to_m ? on_way : on_leg;
    if (check.cost(directed(point, now.pose.theta)) == in_collision) return {on_leg_m, point};
  }
  return {std::max(leg.length_m, needed_m), {}};
}

}  // namespace dmrp::controllers
