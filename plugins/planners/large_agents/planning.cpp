// SPDX-License-Identifier: MIT
#include "planners/large_agents/planning.hpp"

#include <algorithm>

#include "planners/large_agents/conflict_search.hpp"
#include "planners/large_agents/prioritized_planning.hpp"

namespace dmrp::planners {

FleetAnswer plan_by_conflict_search(const PlanningProblem& problem, double suboptimality, std::int64_t node_limit,
                                    StopSignal& stop, PlanSink& sink) {
  const auto prepared = prepare_fleet(problem, stop);
  if (!prepared) return {Status::timeout, "stopped by the host"};
  if (!prepared->obstruction.empty()) return {Status::no_solution, prepared->obstruction};

  LargeAgentSearch search(*prepared, suboptimality, node_limit, stop);
  const LargeAgentSearch::Result result = search.run();
  sink.statistic("lower_bound", std::max(search.lower_bound(), prepared->lower_bound()));
  sink.statistic("high_level_expanded", static_cast<double>(search.expanded()));
  sink.statistic("high_level_generated", static_cast<double>(search.generated()));
  sink.statistic("low_level_expanded", static_cast<double>(search.low_level_expanded()));
  switch (result) {
    case LargeAgentSearch::Result::solved: {
      const std::vector<PathView> paths = search.solution();
      sink.statistic("cost", static_cast<double>(sum_of_costs(paths)));
      write_paths(problem, prepared->fleet, paths, sink);
      return {};
    }
    case LargeAgentSearch::Result::unsolvable:
      return {Status::no_solution, "every order in which the robots could give way to each other was tried"};
    case LargeAgentSearch::Result::stopped:
      return {Status::timeout, "stopped by the host"};
    case LargeAgentSearch::Result::node_limit:
      return {Status::timeout, "no plan within node_limit = " + std::to_string(node_limit) + " nodes"};
  }
  return {Status::error, ""};
}

FleetAnswer plan_by_priorities(const PlanningProblem& problem, std::int64_t restart_limit, std::uint64_t seed,
                               StopSignal& stop, PlanSink& sink) {
  const auto prepared = prepare_fleet(problem, stop);
  if (!prepared) return {Status::timeout, "stopped by the host"};
  if (!prepared->obstruction.empty()) return {Status::no_solution, prepared->obstruction};

  sink.statistic("lower_bound", prepared->lower_bound());
  PrioritizedFleet search(*prepared, seed, stop);
  const PrioritizedFleet::Result result = search.run(restart_limit);
  sink.statistic("low_level_expanded", static_cast<double>(search.low_level_expanded()));
  sink.statistic("restarts", static_cast<double>(std::min(search.restarts(), restart_limit)));
  sink.statistic("displaced", static_cast<double>(search.displaced()));
  if (result == PrioritizedFleet::Result::stopped) return {Status::timeout, "stopped by the host"};
  if (result == PrioritizedFleet::Result::restart_limit)
    return {Status::timeout, "no plan after restarts = " + std::to_string(restart_limit)};
  sink.statistic("cost", static_cast<double>(sum_of_costs(search.paths())));
  write_paths(problem, prepared->fleet, {search.paths().begin(), search.paths().end()}, sink);
  return {};
}

}  // namespace dmrp::planners
