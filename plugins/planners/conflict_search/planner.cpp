// SPDX-License-Identifier: MIT
#include "planners/conflict_search/planner.hpp"

#include <algorithm>
#include <numeric>

#include "planners/conflict_search/high_level/high_level.hpp"
#include "planners/large_agents/planning.hpp"
#include "planners/mapf/solvability.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/mapf/unequal_robots.hpp"

namespace dmrp::planners {

Status ConflictSearchPlanner::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  StopSignal stop([this] { return should_stop(); });
  if (find_unequal_robots(host_problem)) {
    const ConflictSearchOptions chosen = options();
    const FleetAnswer answer =
        plan_by_conflict_search(host_problem, chosen.suboptimality, chosen.node_limit, stop, sink);
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

  const ConflictSearchOptions chosen = options();
  MddCache mdds(problem, *tables, &stop);
  CorridorReasoning corridors(problem, *tables, stop);
  const SearchContext context = {problem, *tables, corridors, mdds, stop};
  PairWeights weights(context, chosen);
  HighLevel search(context, chosen, chosen.dependency_graph ? &weights : nullptr);
  std::vector<std::int32_t> all_agents(problem.agents.size());
  std::iota(all_agents.begin(), all_agents.end(), 0);
  const HighLevel::Result result = search.run(all_agents, {});

  const ConflictSearchStatistics statistics = search.statistics();
  // a search that was stopped early has proved less than the robots' costs alone
  double alone = 0;
  for (std::size_t i = 0; i < problem.agents.size(); ++i) alone += (*tables)[i].distance(0, problem.agents[i].start);
  sink.statistic("lower_bound", std::max(statistics.lower_bound, alone));
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
      straighten(problem, *tables, paths, straightening_limit(paths.size(), statistics.low_level_expanded), stop);
      write_paths(host_problem, problem, {paths.begin(), paths.end()}, sink);
      return Status::ok;
    }
    case HighLevel::Result::unsolvable:
      set_error(search.obstruction());
      return Status::no_solution;
    case HighLevel::Result::stopped:
      set_error("stopped by the host");
      return Status::timeout;
    case HighLevel::Result::limit:
      set_error("no plan within node_limit = " + std::to_string(chosen.node_limit) + " nodes");
      return Status::timeout;
  }
  return Status::error;
}

}  // namespace dmrp::planners
