// SPDX-License-Identifier: MIT
#include "individual.hpp"

#include "../mapf/problem.hpp"
#include "../mapf/tour_table.hpp"

namespace dmrp::planners {

Descriptor Individual::describe() {
  return Descriptor("dmrp.planner.individual", "Individual paths", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("each robot's own shortest path with fewest turns, regardless of the others")
      .connectivity(DMRP_CONNECTIVITY_4)
      .uncoordinated();
}

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
  std::vector<PathView> views;
  double cost = 0;
  for (const TourTable& table : *tables) {
    paths.push_back(table.shortest_path());
    cost += cost_of(paths.back());
  }
  views.assign(paths.begin(), paths.end());
  write_paths(host_problem, problem, views, sink);
  sink.statistic("cost", cost);
  sink.statistic("lower_bound", cost);
  return Status::ok;
}

}  // namespace dmrp::planners
