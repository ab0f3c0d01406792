// SPDX-License-Identifier: MIT
#include "planners/lns/lns.hpp"

#include "planners/lacam/lacam_search.hpp"
#include "planners/lns/large_neighborhood_search.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/sipp/prioritized_search.hpp"

namespace dmrp::planners {

namespace {

// Prioritized planning is left when it has expanded so many states for each step of the robots' costs alone, and more
// than until then, without halving the number of robots that have no path. Where it comes to its end, its plans are much cheaper than the first
// ones of LaCAM*.
constexpr double patience_a_step = 60;

struct FirstPlan {
  Status status = Status::ok;
  std::string error;
  std::vector<std::vector<Location>> paths;
};

// The cheaper one of two quick plans.
FirstPlan find_first_plan(const Preparation& prepared, std::uint64_t seed, StopSignal& stop) {
  FirstPlan first;
  LacamSearch lacam(prepared.problem, prepared.tables, seed, stop);
  const LacamSearch::Result result = lacam.run(0);
  if (lacam.has_plan()) {
    first.paths = std::move(lacam.paths());
  } else if (result == LacamSearch::Result::unsolvable) {
    return {Status::no_solution, "all configurations that the robots can reach were visited", {}};
  } else if (result == LacamSearch::Result::stopped) {
    return {Status::timeout, "stopped by the host", {}};
  }
  PrioritizedSearch prioritized(prepared.problem, prepared.tables, seed, stop);
  const double patience = patience_a_step * prepared.lower_bound();
  if (prioritized.run_once(static_cast<std::int64_t>(patience)) == PrioritizedSearch::Result::solved &&
      (first.paths.empty() || sum_of_costs(prioritized.paths()) < sum_of_costs(first.paths)))
    first.paths = std::move(prioritized.paths());
  if (first.paths.empty() && !prepared.problem.agents.empty())
    return {Status::timeout, "neither prioritized planning nor LaCAM* within 2 GB found a first plan", {}};
  return first;
}

}  // namespace

Descriptor Lns::describe() {
  return describe_planner("dmrp.planner.lns", "MAPF-LNS", "1.0.0")
      .summary("a quick plan, improved a few robots at a time by large neighborhood search")
      .source(
          "Li, Chen, Harabor, Stuckey, Koenig: Anytime multi-agent path finding via large neighborhood search, IJCAI "
          "2021; first plan: dmrp.planner.sipp, dmrp.planner.lacam");
}

Status Lns::solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop, PlanSink& sink) {
  sink.statistic("lower_bound", prepared.lower_bound());
  FirstPlan first = find_first_plan(prepared, seed(), stop);
  if (first.status != Status::ok) return fail(first.status, first.error);
  sink.statistic("first_cost", static_cast<double>(sum_of_costs(first.paths)));
  LargeNeighborhoodSearch search(prepared.problem, prepared.tables, std::move(first.paths), seed(), stop);
  search.run(*iterations > 0 ? *iterations : -1);
  sink.statistic("iterations", static_cast<double>(search.iterations()));
  sink.statistic("low_level_expanded", static_cast<double>(search.low_level_expanded()));
  sink.statistic("cost", static_cast<double>(search.cost()));
  std::vector<std::vector<Location>>& paths = search.plan().paths;
  straighten(prepared.problem, prepared.tables, search.plan().occupied, paths,
             straightening_limit(paths.size(), search.low_level_expanded()), stop);
  write_paths(host_problem, prepared.problem, {paths.begin(), paths.end()}, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
