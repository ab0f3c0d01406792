// SPDX-License-Identifier: MIT
#include "planners/conflict_search/planner.hpp"

#include <algorithm>
#include <numeric>

#include "planners/conflict_search/high_level/high_level.hpp"
#include "planners/large_agents/planning.hpp"
#include "planners/mapf/straighten.hpp"

namespace dmrp::planners {

Status ConflictSearchPlanner::plan_unequal(const PlanningProblem& host_problem, const std::string&, StopSignal& stop,
                                           PlanSink& sink) {
  const ConflictSearchOptions chosen = options();
  const FleetAnswer answer = plan_by_conflict_search(host_problem, chosen.suboptimality, *node_limit, stop, sink);
  return answer.error.empty() ? answer.status : fail(answer.status, answer.error);
}

Status ConflictSearchPlanner::solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
                                    PlanSink& sink) {
  const auto& [problem, tables] = prepared;
  ConflictSearchOptions chosen = options();
  chosen.safe_intervals = *safe_intervals;
  chosen.node_limit = *node_limit;
  MddCache mdds(problem, tables, &stop);
  CorridorReasoning corridors(problem, tables, stop);
  const SearchContext context = {problem, tables, corridors, mdds, stop};
  PairWeights weights(context, chosen);
  HighLevel search(context, chosen, chosen.dependency_graph ? &weights : nullptr);
  std::vector<std::int32_t> all_agents(problem.agents.size());
  std::iota(all_agents.begin(), all_agents.end(), 0);
  const HighLevel::Result result = search.run(all_agents, {});

  const ConflictSearchStatistics statistics = search.statistics();
  // a search that was stopped early has proved less than the robots' costs alone
  sink.statistic("lower_bound", std::max(statistics.lower_bound, prepared.lower_bound()));
  sink.statistic("high_level_expanded", static_cast<double>(statistics.high_level_expanded));
  sink.statistic("high_level_generated", static_cast<double>(statistics.high_level_generated));
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  switch (result) {
    case HighLevel::Result::solved: {
      std::vector<std::vector<Location>> paths;
      double cost = 0;
      for (const AgentPath& path : search.solution()) {
        paths.emplace_back(path.locations.begin(), path.locations.end());
        cost += cost_of(path.locations);
      }
      sink.statistic("cost", cost);
      straighten(problem, tables, paths, straightening_limit(paths.size(), statistics.low_level_expanded), stop);
      write_paths(host_problem, problem, {paths.begin(), paths.end()}, sink);
      return Status::ok;
    }
    case HighLevel::Result::unsolvable:
      return fail(Status::no_solution, search.obstruction());
    case HighLevel::Result::stopped:
      return fail(Status::timeout, "stopped by the host");
    case HighLevel::Result::limit:
      return fail(Status::timeout, "no plan within node_limit = " + std::to_string(chosen.node_limit) + " nodes");
  }
  return Status::error;
}

}  // namespace dmrp::planners
