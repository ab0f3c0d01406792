// SPDX-License-Identifier: MIT
#include "planners/sipp/sipp.hpp"

#include "planners/large_agents/planning.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/sipp/prioritized_search.hpp"

namespace dmrp::planners {

Descriptor Sipp::describe() {
  return describe_planner("dmrp.planner.sipp", "Prioritized SIPP", "1.0.0")
      .summary("robots planned one after the other in the safe intervals that the earlier ones leave")
      .source(
          "Phillips, Likhachev: SIPP: Safe interval path planning for dynamic environments, ICRA 2011; displacing "
          "robots by SIPPS: Li et al.: MAPF-LNS2, AAAI 2022");
}

Status Sipp::plan_unequal(const PlanningProblem& host_problem, const std::string&, StopSignal& stop, PlanSink& sink) {
  const FleetAnswer answer = plan_by_priorities(host_problem, *restarts, seed(), stop, sink);
  return answer.error.empty() ? answer.status : fail(answer.status, answer.error);
}

Status Sipp::solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop, PlanSink& sink) {
  sink.statistic("lower_bound", prepared.lower_bound());
  PrioritizedSearch search(prepared.problem, prepared.tables, seed(), stop);
  const PrioritizedSearch::Result result = search.run(restarts);
  const PrioritizedStatistics statistics = search.statistics();
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  sink.statistic("restarts", static_cast<double>(statistics.restarts));
  sink.statistic("displaced", static_cast<double>(statistics.displaced));
  switch (result) {
    case PrioritizedSearch::Result::solved:
      break;
    case PrioritizedSearch::Result::unsolvable:
      return fail(Status::no_solution, search.obstruction());
    case PrioritizedSearch::Result::stopped:
      return fail(Status::timeout, "stopped by the host");
    case PrioritizedSearch::Result::restart_limit:
      return fail(Status::timeout, "no plan after restarts = " + std::to_string(*restarts));
  }

  std::vector<std::vector<Location>>& paths = search.paths();
  straighten(prepared.problem, prepared.tables, search.occupied(), paths,
             straightening_limit(paths.size(), statistics.low_level_expanded), stop);
  sink.statistic("cost", static_cast<double>(sum_of_costs(paths)));
  write_paths(host_problem, prepared.problem, {paths.begin(), paths.end()}, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
