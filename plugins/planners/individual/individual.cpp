// SPDX-License-Identifier: MIT
#include "planners/individual/individual.hpp"

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
  const Problem problem = make_problem(host_problem, false);
  StopSignal stop([this] { return should_stop(); });
  const auto tables = make_tour_tables(problem, stop);
  if (!tables) return Status::timeout;
  if (const auto robot = find_cut_off_robot(problem, *tables)) {
    set_error("robot " + std::to_string(*robot) + " cannot reach its goal");
    return Status::no_solution;
  }

  std::vector<std::vector<Location>> paths;
  double cost = 0;
  for (std::size_t i = 0; i < problem.agents.size(); ++i) {
    paths.push_back(shortest_path(problem.graph, problem.agents[i], (*tables)[i]));
    cost += cost_of(paths.back());
  }
  straighten_alone(problem, *tables, paths, stop);
  if (stop.raised()) return Status::timeout;
  write_paths(host_problem, problem, {paths.begin(), paths.end()}, sink);
  sink.statistic("cost", cost);
  sink.statistic("lower_bound", cost);
  return Status::ok;
}

}  // namespace dmrp::planners
