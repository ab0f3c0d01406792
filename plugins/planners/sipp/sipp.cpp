// SPDX-License-Identifier: MIT
#include "planners/sipp/sipp.hpp"

#include "planners/large_agents/planning.hpp"
#include "planners/mapf/solvability.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/mapf/unequal_robots.hpp"
#include "planners/sipp/prioritized_search.hpp"

namespace dmrp::planners {

Descriptor Sipp::describe() {
  return Descriptor("dmrp.planner.sipp", "Prioritized SIPP", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("robots planned one after the other in the safe intervals that the earlier ones leave")
      .source(
          "Phillips, Likhachev: SIPP: Safe interval path planning for dynamic environments, ICRA 2011; displacing "
          "robots by SIPPS: Li et al.: MAPF-LNS2, AAAI 2022")
      .connectivity(DMRP_CONNECTIVITY_4);
}

Status Sipp::start(const Start& start) {
  seed_ = start.seed;
  return Status::ok;
}

Status Sipp::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  StopSignal stop([this] { return should_stop(); });
  if (find_unequal_robots(host_problem)) {
    const FleetAnswer answer = plan_by_priorities(host_problem, *restarts, seed_, stop, sink);
    if (!answer.error.empty()) set_error(answer.error);
    return answer.status;
  }
  const Problem problem = make_problem(host_problem, true);
  const auto tables = make_tour_tables(problem, stop);
  if (!tables) return Status::timeout;
  if (const auto robot = find_cut_off_robot(problem, *tables)) {
    set_error("robot " + std::to_string(*robot) + " cannot reach its goal");
    return Status::no_solution;
  }
  if (const auto obstruction = find_obvious_obstruction(problem)) {
    set_error(*obstruction);
    return Status::no_solution;
  }
  double lower_bound = 0;
  for (std::size_t i = 0; i < problem.agents.size(); ++i)
    lower_bound += (*tables)[i].distance(0, problem.agents[i].start);
  sink.statistic("lower_bound", lower_bound);

  PrioritizedSearch search(problem, *tables, seed_, stop);
  const PrioritizedSearch::Result result = search.run(restarts);
  const PrioritizedStatistics statistics = search.statistics();
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  sink.statistic("restarts", static_cast<double>(statistics.restarts));
  sink.statistic("displaced", static_cast<double>(statistics.displaced));
  switch (result) {
    case PrioritizedSearch::Result::solved:
      break;
    case PrioritizedSearch::Result::unsolvable:
      set_error(search.obstruction());
      return Status::no_solution;
    case PrioritizedSearch::Result::stopped:
      set_error("stopped by the host");
      return Status::timeout;
    case PrioritizedSearch::Result::restart_limit:
      set_error("no plan after restarts = " + std::to_string(*restarts));
      return Status::timeout;
  }

  std::vector<std::vector<Location>>& paths = search.paths();
  straighten(problem, *tables, search.occupied(), paths,
             straightening_limit(paths.size(), statistics.low_level_expanded), stop);
  sink.statistic("cost", static_cast<double>(sum_of_costs(paths)));
  write_paths(host_problem, problem, {paths.begin(), paths.end()}, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
