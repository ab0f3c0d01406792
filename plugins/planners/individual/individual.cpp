// SPDX-License-Identifier: MIT
#include "planners/individual/individual.hpp"

#include <algorithm>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

Descriptor Individual::describe() {
  return Descriptor("dmrp.planner.individual", "Individual paths", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("each robot's own shortest path with fewest turns, regardless of the others")
      .connectivity(DMRP_CONNECTIVITY_4)
      .uncoordinated();
}

namespace {

// The active robots of each grid, on that grid.
std::vector<Problem> problems_by_grid(const PlanningProblem& host_problem) {
  std::vector<Problem> problems;
  std::vector<const dmrp_grid*> grids;
  for (std::uint32_t i = 0; i < host_problem.robots.size(); ++i) {
    const PlanningRobot& robot = host_problem.robots[i];
    if (robot.state != DMRP_ROBOT_ACTIVE) continue;
    const auto known = std::find(grids.begin(), grids.end(), robot.grid);
    const auto number = static_cast<std::size_t>(known - grids.begin());
    if (known == grids.end()) {
      grids.push_back(robot.grid);
      problems.push_back({GridGraph(*robot.grid), {}});
    }
    problems[number].agents.push_back(agent_on(problems[number].graph, robot, i));
  }
  return problems;
}

// Of the directions with least cost it takes the one straight ahead, if that is among them.
std::vector<Location> shortest_path(const GridGraph& graph, const Agent& agent, const TourTable& table) {
  std::vector<Location> path = {agent.start};
  Direction heading = 0;
  for (std::int32_t leg = 0, rest = table.distance(0, agent.start); rest > 0; --rest) {
    const Location from = path.back();
    leg = agent.leg_after(leg, from);
    Location next = from;  // a wait, between equal goals
    for (Direction i = 0; i < GridGraph::direction_count && next == from; ++i) {
      const Direction d = (heading + i) % GridGraph::direction_count;
      const Location to = graph.neighbor(from, d);
      if (to == nowhere || table.distance(leg, to) != rest - 1) continue;
      next = to;
      heading = d;
    }
    path.push_back(next);
  }
  return path;
}

}  // namespace

Status Individual::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  StopSignal stop([this] { return should_stop(); });
  double cost = 0;
  for (const Problem& problem : problems_by_grid(host_problem)) {
    const auto tables = make_tour_tables(problem, stop);
    if (!tables) return Status::timeout;
    if (const auto robot = find_cut_off_robot(problem, *tables)) {
      set_error("robot " + std::to_string(*robot) + " cannot reach its goal");
      return Status::no_solution;
    }
    std::vector<std::vector<Location>> paths;
    for (std::size_t i = 0; i < problem.agents.size(); ++i) {
      paths.push_back(shortest_path(problem.graph, problem.agents[i], (*tables)[i]));
      cost += cost_of(paths.back());
    }
    straighten_alone(problem, *tables, paths, stop);
    if (stop.raised()) return Status::timeout;
    for (std::size_t i = 0; i < paths.size(); ++i)
      write_path(host_problem, problem.graph, problem.agents[i], paths[i], sink);
  }
  write_resting_robots(host_problem, sink);
  sink.statistic("cost", cost);
  sink.statistic("lower_bound", cost);
  return Status::ok;
}

}  // namespace dmrp::planners
