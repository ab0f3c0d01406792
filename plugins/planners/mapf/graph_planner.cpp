// SPDX-License-Identifier: MIT
#include "planners/mapf/graph_planner.hpp"

#include "planners/mapf/solvability.hpp"
#include "planners/mapf/unequal_robots.hpp"

namespace dmrp::planners {

Status GraphPlanner::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  StopSignal stop([this] { return should_stop(); });
  if (const auto unequal = find_unequal_robots(host_problem)) return plan_unequal(host_problem, *unequal, stop, sink);
  Preparation prepared{make_problem(host_problem, true), {}};
  auto tables = make_tour_tables(prepared.problem, stop);
  if (!tables) return Status::timeout;
  prepared.tables = std::move(*tables);
  if (const auto robot = find_cut_off_robot(prepared.problem, prepared.tables))
    return fail(Status::no_solution, "robot " + std::to_string(*robot) + " cannot reach its goal");
  if (const auto obstruction = find_obvious_obstruction(prepared.problem))
    return fail(Status::no_solution, *obstruction);
  return solve(host_problem, prepared, stop, sink);
}

Status GraphPlanner::plan_unequal(const PlanningProblem&, const std::string& unequal, StopSignal&, PlanSink&) {
  return fail(Status::no_solution, refusal(unequal));
}

}  // namespace dmrp::planners
