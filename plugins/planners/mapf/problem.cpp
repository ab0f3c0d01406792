// SPDX-License-Identifier: MIT
#include "planners/mapf/problem.hpp"

#include <cassert>
namespace dmrp::planners {

namespace {

constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();

Waypoint waypoint_at(dmrp_vec2 point, std::int64_t t_ns, std::uint32_t goal_index) {
  return {point.x, point.y, any_heading, t_ns, goal_index, 0};
}

}  // namespace

template <Direction connectivity>
void write_path(const PlanningProblem& host_problem, const BasicGridGraph<connectivity>& graph, const Agent& agent,
                PathView path, PlanSink& sink) {
  assert(!path.empty());
  std::vector<Waypoint> waypoints;
  waypoints.reserve(path.size());
  std::int64_t t_ns = host_problem.effective_from_ns;
  std::int32_t leg = 0;
  for (const Location location : path) {
    const dmrp_vec2 point = waypoints.empty() ? host_problem.robots[agent.robot].start : graph.center(location);
    waypoints.push_back(waypoint_at(point, t_ns, agent.first_goal_index + static_cast<std::uint32_t>(leg)));
    leg = agent.leg_after(leg, location);
    t_ns += host_problem.step_duration_ns;
  }
  const bool ends_at_goal = leg == agent.last_leg() && path.back() == agent.last_goal();
  sink.path(agent.robot, waypoints, !ends_at_goal);
}

void write_resting_robots(const PlanningProblem& host_problem, PlanSink& sink) {
  for (std::uint32_t i = 0; i < host_problem.robots.size(); ++i) {
    const PlanningRobot& robot = host_problem.robots[i];
    if (robot.state != DMRP_ROBOT_ACTIVE)
      sink.path(i, {waypoint_at(robot.start, host_problem.effective_from_ns, robot.first_goal_index)});
  }
}

template <Direction connectivity>
Agent agent_on(const BasicGridGraph<connectivity>& graph, const PlanningRobot& robot, std::uint32_t number) {
  Agent agent{number, graph.locate(robot.start), {}, robot.first_goal_index};
  for (const Goal& goal : robot.goals()) agent.goals.push_back(graph.locate({goal.pose.x, goal.pose.y}));
  return agent;
}

template <Direction connectivity>
BasicProblem<connectivity> make_problem(const PlanningProblem& problem, bool resting_robots_block) {
  BasicProblem<connectivity> out{BasicGridGraph<connectivity>(problem.grid), {}};
  if (resting_robots_block)
    for (const PlanningRobot& robot : problem.robots) {
      const Location cell = out.graph.locate(robot.start);
      if (robot.state != DMRP_ROBOT_ACTIVE && cell != nowhere) out.graph.block(cell);
    }
  for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
    const PlanningRobot& robot = problem.robots[i];
    if (robot.state == DMRP_ROBOT_ACTIVE) out.agents.push_back(agent_on(out.graph, robot, i));
  }
  return out;
}

template <Direction connectivity>
void write_paths(const PlanningProblem& host_problem, const BasicProblem<connectivity>& problem,
                 const std::vector<PathView>& paths, PlanSink& sink) {
  assert(paths.size() == problem.agents.size());
  for (std::size_t i = 0; i < paths.size(); ++i)
    write_path(host_problem, problem.graph, problem.agents[i], paths[i], sink);
  write_resting_robots(host_problem, sink);
}

template <Direction connectivity>
std::int32_t count_turns(const BasicGridGraph<connectivity>& graph, PathView path) {
  std::int32_t turns = 0;
  Direction heading = graph.no_direction;
  for (std::size_t t = 1; t < path.size(); ++t)
    for (Direction d = 0; d < graph.direction_count; ++d) {
      if (path[t] == path[t - 1] || graph.neighbor(path[t - 1], d) != path[t]) continue;
      if (heading != graph.no_direction && d != heading) ++turns;
      heading = d;
    }
  return turns;
}

template Agent agent_on(const BasicGridGraph<4>&, const PlanningRobot&, std::uint32_t);
template Agent agent_on(const BasicGridGraph<8>&, const PlanningRobot&, std::uint32_t);
template BasicProblem<4> make_problem<4>(const PlanningProblem&, bool);
template BasicProblem<8> make_problem<8>(const PlanningProblem&, bool);
template void write_path(const PlanningProblem&, const BasicGridGraph<4>&, const Agent&, PathView, PlanSink&);
template void write_path(const PlanningProblem&, const BasicGridGraph<8>&, const Agent&, PathView, PlanSink&);
template void write_paths(const PlanningProblem&, const BasicProblem<4>&, const std::vector<PathView>&, PlanSink&);
template void write_paths(const PlanningProblem&, const BasicProblem<8>&, const std::vector<PathView>&, PlanSink&);
template std::int32_t count_turns(const BasicGridGraph<4>&, PathView);
template std::int32_t count_turns(const BasicGridGraph<8>&, PathView);

}  // namespace dmrp::planners
