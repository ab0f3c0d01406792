// SPDX-License-Identifier: MIT
#include "tests/contract_wishes/planning.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace dmrp::test {

namespace {

constexpr std::int64_t step_ns = 1'000'000'000;

std::int32_t receive_path(dmrp_plan_sink* sink, std::uint32_t robot, const dmrp_path* path) {
  auto& paths = static_cast<Planning*>(sink->context)->paths;
  if (robot >= paths.size() || !paths[robot].waypoints.empty()) return DMRP_ERROR;
  paths[robot].stride = path->stride;
  for (std::uint32_t i = 0; i < path->count; ++i)
    paths[robot].waypoints.push_back(*DMRP_AT(dmrp_waypoint, path->waypoints, path->stride, i));
  paths[robot].bytes.resize(std::size_t{path->stride} * path->count);
  std::memcpy(paths[robot].bytes.data(), path->waypoints, paths[robot].bytes.size());
  return DMRP_OK;
}

std::int32_t receive_statistic(dmrp_plan_sink* sink, const char* name, double value) {
  if (std::string(name) == "cost") static_cast<Planning*>(sink->context)->cost = value;
  return DMRP_OK;
}

}  // namespace

Planning::Planning(World& world, const std::vector<dmrp_vec2>& starts) : robots(starts.size()), world_(world) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    robots[i].known.grid = world.grid();
    robots[i].known.pose = {starts[i].x, starts[i].y, 0.0};
    robots[i].known.start = starts[i];
  }
}

std::int32_t Planning::plan(const Instance& planner) {
  world_.c();
  std::vector<Longer<dmrp_path>> in_force;
  for (const auto& waypoints : in_force_)
    in_force.push_back(
        {{sizeof(dmrp_path), count_of(waypoints), sizeof(waypoints.front()), 0, &waypoints.front().known}});
  for (std::size_t i = 0; i < robots.size(); ++i) {
    dmrp_planning_robot& robot = robots[i].known;
    const auto& goals = world_.robot_data[i].goals;
    robot.robot = &world_.robots[i].known;
    robot.goal_count = count_of(goals) - robot.first_goal_index;
    robot.goals = robot.goal_count == 0 ? nullptr : &goals[robot.first_goal_index].known;
    robot.goal_stride = sizeof(goals.front());
  }
  dmrp_planning_problem problem{};
  problem.struct_size = sizeof(problem);
  problem.robots = &robots.front().known;
  problem.robot_count = count_of(robots);
  problem.robot_stride = sizeof(robots.front());
  problem.revision = ++revision_;
  problem.now_ns = now_ns_;
  problem.effective_from_ns = now_ns_;
  problem.step_duration_ns = step_ns;
  problem.grid = world_.grid();
  problem.in_force = in_force.empty() ? nullptr : &in_force.front().known;
  problem.in_force_count = count_of(in_force);
  problem.in_force_stride = sizeof(Longer<dmrp_path>);

  paths.assign(robots.size(), {});
  dmrp_plan_sink sink = {sizeof(sink), 0, this, receive_path, receive_statistic};
  const std::int32_t status = planner.as<dmrp_global_planner>().plan(planner.c.self, &problem, &sink);
  if (status == DMRP_OK) {
    in_force_.clear();
    for (const GivenPath& path : paths) {
      in_force_.emplace_back();
      for (const dmrp_waypoint& waypoint : path.waypoints) in_force_.back().push_back({waypoint});
    }
  }
  return status;
}

void Planning::drive(std::size_t steps) {
  now_ns_ += static_cast<std::int64_t>(steps) * step_ns;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const auto& waypoints = paths[i].waypoints;
    const dmrp_waypoint& at = waypoints[std::min(steps, waypoints.size() - 1)];
    robots[i].known.pose = {at.x, at.y, 0.0};
    robots[i].known.start = {at.x, at.y};
    robots[i].known.first_goal_index = at.goal_index;
    if (steps + 1 >= waypoints.size()) {
      robots[i].known.state = DMRP_ROBOT_FINISHED;
      robots[i].known.first_goal_index = count_of(world_.robot_data[i].goals);
    }
  }
}

std::string fault_of(const Planning& planning, const World& world) {
  const auto at = [&](std::size_t robot, std::size_t step) {
    const auto& waypoints = planning.paths[robot].waypoints;
    return waypoints[std::min(step, waypoints.size() - 1)];
  };
  const auto cell = [&](std::size_t robot, std::size_t step) {
    return world.cell(at(robot, step).x, at(robot, step).y);
  };
  std::size_t longest = 0;
  for (std::size_t i = 0; i < planning.paths.size(); ++i) {
    const std::string name = "robot " + std::to_string(i);
    const auto& waypoints = planning.paths[i].waypoints;
    const dmrp_planning_robot& robot = planning.robots[i].known;
    if (waypoints.empty()) return name + " has no path";
    if (waypoints.front().x != robot.start.x || waypoints.front().y != robot.start.y) return name + " starts elsewhere";
    longest = std::max(longest, waypoints.size());
    std::size_t reached = robot.first_goal_index;
    const auto& goals = world.robot_data[i].goals;
    for (std::size_t k = 0; k < waypoints.size(); ++k) {
      if (!world.is_free(cell(i, k))) return name + " hits a wall";
      if (k > 0 && std::abs(waypoints[k].x - waypoints[k - 1].x) + std::abs(waypoints[k].y - waypoints[k - 1].y) > 1.0)
        return name + " jumps";
      if (k > 0 && waypoints[k].t_ns != waypoints[k - 1].t_ns + step_ns) return name + " is out of step";
      while (reached < goals.size() && goals[reached].known.pose.x == waypoints[k].x &&
             goals[reached].known.pose.y == waypoints[k].y)
        ++reached;
    }
    if (reached < goals.size()) return name + " misses a goal";
  }
  for (std::size_t i = 0; i < planning.paths.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < longest; ++k)
        if (cell(i, k) == cell(j, k) || (cell(i, k) == cell(j, k + 1) && cell(i, k + 1) == cell(j, k)))
          return "robots " + std::to_string(j) + " and " + std::to_string(i) + " collide at step " + std::to_string(k);
  return "";
}

}  // namespace dmrp::test
