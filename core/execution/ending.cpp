// SPDX-License-Identifier: MIT
#include "core/execution/ending.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::core {

EndingMonitor::EndingMonitor(std::uint32_t robot_count, std::int64_t time_limit_ns)
    : time_limit_ns_(time_limit_ns), robots_(robot_count) {}

void EndingMonitor::restart(std::uint32_t robot, std::int64_t t_ns) {
  robots_[robot].history.clear();
  command_given(robot, t_ns);
}

std::uint32_t EndingMonitor::update(std::int64_t t_ns, std::span<const RobotState> robots,
                                    std::span<const double> gained_m, bool deserted) {
  assert(robots.size() == robots_.size() && gained_m.size() == robots_.size());
  if (robots_.empty()) return deserted ? DMRP_ENDING_DESERTED : t_ns >= time_limit_ns_ ? DMRP_ENDING_TIME_LIMIT : 0;
  bool all_arrived = true;
  bool all_stall = true;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    Watched& watched = robots_[i];
    const bool arrived = robots[i].state == DMRP_ROBOT_FINISHED;
    const bool stalls = watch(watched, t_ns, robots[i], gained_m[i]);
    if (arrived) continue;
    all_arrived = false;
    all_stall = all_stall && stalls;
    if (robots[i].state != DMRP_ROBOT_ACTIVE) continue;
    if (watched.failure == DMRP_FAILURE_NONE && t_ns - watched.last_command_ns >= controller_silence_ns)
      watched.failure = DMRP_FAILURE_CONTROLLER;
  }
  if (all_arrived) return DMRP_ENDING_ARRIVED;
  if (t_ns >= time_limit_ns_) return DMRP_ENDING_TIME_LIMIT;
  return all_stall ? DMRP_ENDING_DEADLOCK : 0;
}

// Records the robot's motion. Returns whether it gained less than stall_progress_m over the whole window.
bool EndingMonitor::watch(Watched& watched, std::int64_t t_ns, const RobotState& robot, double gained_m) {
  if (!watched.history.empty()) {
    watched.travelled_m += toolkit::distance(toolkit::position(watched.last_pose), toolkit::position(robot.pose));
    watched.turned_rad += std::abs(toolkit::difference(watched.last_pose.theta, robot.pose.theta));
  }
  watched.last_pose = robot.pose;
  watched.history.push_back({t_ns, gained_m, watched.travelled_m, watched.turned_rad});

  // The oldest moment kept is the latest that is at least a whole window old.
  while (watched.history.size() > 1 && watched.history[1].t_ns <= t_ns - stall_window_ns) watched.history.pop_front();
  const Moment& then = watched.history.front();
  const bool stalls = t_ns - then.t_ns >= stall_window_ns && gained_m - then.gained_m < stall_progress_m;
  const bool oscillates = watched.travelled_m - then.travelled_m > oscillation_travel_m ||
                          watched.turned_rad - then.turned_rad > oscillation_turn_rad;
  if (stalls && oscillates && robot.state == DMRP_ROBOT_ACTIVE && watched.failure == DMRP_FAILURE_NONE)
    watched.failure = DMRP_FAILURE_OSCILLATION;
  return stalls;
}

std::vector<dmrp_robot_end> EndingMonitor::robot_ends(std::uint32_t ending, std::span<const RobotState> robots) const {
  assert(ending != 0 && robots.size() == robots_.size());
  std::vector<dmrp_robot_end> ends;
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    std::uint32_t failure = robots_[i].failure;
    if (failure == DMRP_FAILURE_NONE && robots[i].state != DMRP_ROBOT_FINISHED) {
      failure = ending == DMRP_ENDING_DEADLOCK  ? DMRP_FAILURE_DEADLOCK
                : ending == DMRP_ENDING_NO_PLAN ? DMRP_FAILURE_NO_PLAN
                                                : DMRP_FAILURE_TIMEOUT;
    }
    ends.push_back({robots[i].state, failure, robots[i].arrival_ns});
  }
  return ends;
}

}  // namespace dmrp::core
