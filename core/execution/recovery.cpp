// SPDX-License-Identifier: MIT
#include "core/execution/recovery.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

#include "core/execution/clear_way.hpp"
#include "core/scene/robot_task.hpp"
#include "core/world/drive.hpp"

namespace dmrp::core {
namespace {

constexpr double still_speed = 1e-3;  // m/s, rad/s

bool stands(const RobotState& robot) {
  return std::hypot(robot.velocity.v_x, robot.velocity.v_y) < still_speed &&
         std::abs(robot.velocity.omega) < still_speed;
}

}  // namespace

RecoveryLadder::RecoveryLadder(const World& world, std::vector<bool> has_costmap)
    : world_(world), has_costmap_(std::move(has_costmap)), robots_(world.robots().size()) {
  assert(has_costmap_.size() == robots_.size());
}

std::optional<RecoveryAction> RecoveryLadder::act(std::uint32_t robot, double gained_m, bool waits) {
  assert(robot < robots_.size());
  Climber& climber = robots_[robot];
  const RobotState& state = world_.robots()[robot];
  if (state.state != DMRP_ROBOT_ACTIVE) {
    climber.phase = Phase::none;
    return std::nullopt;
  }
  if (climber.phase == Phase::none) {
    if (!is_stuck(robot, gained_m, waits) || climber.recoveries >= settings().retries) return std::nullopt;
    ++climber.recoveries;
    climber.failed = 0;
    if (!begin_step(robot)) return std::nullopt;
  }
  while (climber.phase != Phase::settling) {
    if (climber.phase == Phase::braking) {
      if (!stands(state)) return action(robot, {});
      climber.phase = Phase::acting;
      climber.step_ns = world_.t_ns();
      climber.step_pose = state.pose;
      climber.turned_rad = 0.0;
      climber.last_theta = state.pose.theta;
    }
    dmrp_twist command{};
    const Outcome outcome = act_step(robot, command);
    if (outcome == Outcome::goes_on) return action(robot, command);
    if (outcome == Outcome::succeeded || !step_failed(robot)) climber.phase = Phase::settling;
  }
  if (!stands(state)) return action(robot, {});
  finish(robot);
  return std::nullopt;
}

void RecoveryLadder::controller_answered(std::uint32_t robot, bool has_command) {
  Climber& climber = robots_[robot];
  const std::int64_t now_ns = world_.t_ns();
  if (has_command) climber.command_ns = now_ns;
  climber.controller_fails = now_ns - climber.command_ns > settings().failure_tolerance_ns;
}

bool RecoveryLadder::is_stuck(std::uint32_t robot, double gained_m, bool waits) {
  Climber& climber = robots_[robot];
  const std::uint32_t goal_index = world_.robots()[robot].goal_index;
  if (climber.goal_index != goal_index) {
    climber.goal_index = goal_index;
    climber.recoveries = 0;
    climber.gained_m.reset();
  }
  if (waits || !climber.gained_m || gained_m - *climber.gained_m > settings().required_movement_radius_m) {
    climber.gained_m = gained_m;
    climber.gained_ns = world_.t_ns();
  }
  return climber.controller_fails || world_.t_ns() - climber.gained_ns > settings().movement_time_allowance_ns;
}

bool RecoveryLadder::is_able(std::uint32_t robot, RecoveryStep step) const {
  const RobotSettings& type = world_.robot_settings(robot);
  if (step == RecoveryStep::clear_costmap) return has_costmap_[robot];
  if (step == RecoveryStep::spin) return type.drive != Drive::ackermann;
  if (step == RecoveryStep::backup) return std::min(type.v_min, type.recovery_v_min) < 0.0;
  return true;
}

// The next step that the robot is able to. False: there is none, the recovery is over.
bool RecoveryLadder::begin_step(std::uint32_t robot) {
  Climber& climber = robots_[robot];
  while (climber.failed < settings().steps.size() && !is_able(robot, step_of(climber))) {
    climber.next = (climber.next + 1) % settings().steps.size();
    ++climber.failed;
  }
  if (climber.failed == settings().steps.size()) {
    finish(robot);
    return false;
  }
  climber.phase = Phase::braking;
  climber.begins = true;
  return true;
}

// Goes on with another step. False: all have failed.
bool RecoveryLadder::step_failed(std::uint32_t robot) {
  Climber& climber = robots_[robot];
  climber.next = (climber.next + 1) % settings().steps.size();
  ++climber.failed;
  return begin_step(robot);
}

void RecoveryLadder::finish(std::uint32_t robot) {
  Climber& climber = robots_[robot];
  climber.phase = Phase::none;
  climber.begins = false;
  climber.gained_m.reset();
  climber.command_ns = world_.t_ns();
  climber.controller_fails = false;
}

RecoveryLadder::Outcome RecoveryLadder::act_step(std::uint32_t robot, dmrp_twist& command) {
  Climber& climber = robots_[robot];
  const std::int64_t lasts_ns = world_.t_ns() - climber.step_ns;
  Outcome outcome = Outcome::goes_on;
  switch (step_of(climber)) {
    case RecoveryStep::clear_costmap:
    case RecoveryStep::replan:  // the caller's, at the beginning
      outcome = lasts_ns > 0 ? Outcome::succeeded : Outcome::goes_on;
      break;
    case RecoveryStep::wait:
      outcome = lasts_ns >= settings().wait_duration_ns ? Outcome::succeeded : Outcome::goes_on;
      break;
    case RecoveryStep::spin:
      outcome = lasts_ns > recovery_allowance_ns ? Outcome::failed : spin(robot, command);
      break;
    case RecoveryStep::backup:
      outcome = lasts_ns > recovery_allowance_ns ? Outcome::failed : back_up(robot, command);
      break;
  }
  if (outcome == Outcome::succeeded) climber.next = (climber.next + 1) % settings().steps.size();
  return outcome;
}

RecoveryLadder::Outcome RecoveryLadder::spin(std::uint32_t robot, dmrp_twist& command) {
  Climber& climber = robots_[robot];
  const RobotSettings& type = world_.robot_settings(robot);
  const double theta = world_.robots()[robot].pose.theta;
  climber.turned_rad += toolkit::difference(climber.last_theta, theta);
  climber.last_theta = theta;
  const double left_rad = settings().spin_dist_rad - climber.turned_rad;
  if (left_rad <= 0.0) return Outcome::succeeded;
  const double acceleration = std::min(spin_acceleration, type.alpha_max);
  const double speed = std::clamp(std::sqrt(2.0 * acceleration * left_rad), spin_slowest, spin_fastest);
  command.omega = std::min(speed, type.omega_max);
  return is_clear(robot, command, left_rad) ? Outcome::goes_on : Outcome::failed;
}

RecoveryLadder::Outcome RecoveryLadder::back_up(std::uint32_t robot, dmrp_twist& command) const {
  const Climber& climber = robots_[robot];
  const RobotSettings& type = world_.robot_settings(robot);
  const dmrp_vec2 here = toolkit::position(world_.robots()[robot].pose);
  const double left_m = settings().backup_dist_m - toolkit::distance(toolkit::position(climber.step_pose), here);
  if (left_m <= 0.0) return Outcome::succeeded;
  command.v_x = std::max(-settings().backup_speed, std::min(type.v_min, type.recovery_v_min));
  return is_clear(robot, command, left_m) ? Outcome::goes_on : Outcome::failed;
}

// `remaining`: of the way (m), or of the turn (rad).
bool RecoveryLadder::is_clear(std::uint32_t robot, const dmrp_twist& command, double remaining) const {
  const RobotState& now = world_.robots()[robot];
  const RobotSettings& type = world_.robot_settings(robot);
  dmrp_limits limits = limits_of(type);
  limits.v_min = std::min(type.v_min, type.recovery_v_min);
  const double period_s = 1e-9 * static_cast<double>(world_.settings().control_period_ns);
  const std::int64_t periods = std::max<std::int64_t>(1, recovery_look_ahead_ns / world_.settings().control_period_ns);
  DriveState state = {now.pose, now.velocity, now.steering_rad};
  std::vector<dmrp_pose> poses;
  double done = 0.0;
  for (std::int64_t i = 0; i < periods && done < remaining; ++i) {
    state = advance(state, command, type.drive, limits, period_s);
    poses.push_back(state.pose);
    done += period_s * (command.omega != 0.0 ? std::abs(state.velocity.omega) : std::abs(state.velocity.v_x));
  }
  return way_is_clear(world_, robot, poses);
}

RecoveryAction RecoveryLadder::action(std::uint32_t robot, const dmrp_twist& command) {
  Climber& climber = robots_[robot];
  if (!std::exchange(climber.begins, false)) return {command, std::nullopt};
  return {command, step_of(climber)};
}

}  // namespace dmrp::core
