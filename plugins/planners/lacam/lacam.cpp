// SPDX-License-Identifier: MIT
#include "planners/lacam/lacam.hpp"

#include "planners/lacam/lacam_search.hpp"
#include "planners/mapf/straighten.hpp"

namespace dmrp::planners {

Descriptor Lacam::describe() {
  return describe_planner("dmrp.planner.lacam", "LaCAM*", "1.0.0")
      .summary("complete, for thousands of robots: a lazy search over configurations, with PIBT as their generator")
      .source(
          "Okumura: LaCAM: Search-based algorithm for quick multi-agent pathfinding, AAAI 2023; Improving LaCAM for "
          "scalable eventually optimal multi-agent pathfinding, IJCAI 2023");
}

Status Lacam::solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
                    PlanSink& sink) {
  LacamSearch search(prepared.problem, prepared.tables, seed(), stop);
  const LacamSearch::Result result = search.run(*iterations > 0 ? *iterations : -1);
  const LacamSearch::Statistics& statistics = search.statistics();
  sink.statistic("high_level_expanded", static_cast<double>(statistics.iterations));
  sink.statistic("high_level_generated", static_cast<double>(statistics.configurations));
  sink.statistic("plans", static_cast<double>(statistics.plans));
  if (!search.has_plan()) {
    sink.statistic("lower_bound", prepared.lower_bound());
    if (result == LacamSearch::Result::unsolvable)
      return fail(Status::no_solution, "all configurations that the robots can reach were visited");
    return fail(Status::timeout,
                result == LacamSearch::Result::stopped ? "stopped by the host" : "the search takes more than 2 GB");
  }

  std::vector<std::vector<Location>>& paths = search.paths();
  const std::int64_t moves = sum_of_costs(paths);
  const auto cost = static_cast<double>(moves);
  sink.statistic("cost", cost);
  sink.statistic("lower_bound", result == LacamSearch::Result::optimal ? cost : prepared.lower_bound());
  straighten(prepared.problem, prepared.tables, paths, straightening_limit(paths.size(), moves), stop);
  write_paths(host_problem, prepared.problem, {paths.begin(), paths.end()}, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
