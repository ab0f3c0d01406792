// SPDX-License-Identifier: MIT
#include "planners/lns/lns.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "planners/lacam/lacam_search.hpp"
#include "planners/lns/neighborhoods.hpp"
#include "planners/mapf/straighten.hpp"
#include "planners/sipp/prioritized_search.hpp"
#include "planners/sipp/sipp_search.hpp"

namespace dmrp::planners {

namespace {

// Makes a plan cheaper by planning a few robots at a time again.
//
// MAPF-LNS (Li et al. 2021): removes the paths of some robots and plans them again one after the other in random order,
// by SIPP among all others. Keeps the new paths if their sum of costs is not higher. So the plan has no conflicts after
// every iteration and never gets dearer.
class LargeNeighborhoodSearch {
 public:
  // The paths have no conflicts.
  LargeNeighborhoodSearch(const Problem& problem, const std::vector<TourTable>& tables,
                          std::vector<std::vector<Location>> paths, std::uint64_t seed, StopSignal& stop);

  // For so many iterations (-1: without a limit), until `stop` is raised or no robot loses time.
  void run(std::int64_t iterations);

  ImprovingPlan& plan() { return plan_; }
  std::int64_t cost() const { return cost_; }
  std::int64_t iterations() const { return iterations_; }
  std::int64_t low_level_expanded() const { return low_level_.expanded(); }

 private:
  bool replan(const std::vector<std::int32_t>& agents);
  void replan_each_alone();

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal& stop_;
  toolkit::Stream random_;
  ImprovingPlan plan_;
  SippSearch low_level_;
  Neighborhoods neighborhoods_;
  std::int64_t cost_ = 0;
  std::int64_t least_cost_ = 0;  // the sum of the robots' costs alone
  std::int64_t iterations_ = 0;
  std::vector<std::vector<Location>> kept_;  // the old paths of a neighborhood
};

// Prioritized planning is left when it has expanded so many states for each step of the robots' costs alone, and more
// than until then, without halving the number of robots that have no path. Where it comes to its end, its plans are much cheaper than the first
// ones of LaCAM*.
constexpr double patience_a_step = 60;

struct FirstPlan {
  Status status = Status::ok;
  std::string error;
  std::vector<std::vector<Location>> paths;
};

LargeNeighborhoodSearch::LargeNeighborhoodSearch(const Problem& problem, const std::vector<TourTable>& tables,
                                                 std::vector<std::vector<Location>> paths, std::uint64_t seed,
                                                 StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      stop_(stop),
      random_(seed, "lns"),
      plan_{SafeIntervals(problem.graph), std::move(paths)},
      low_level_(problem.graph, plan_.occupied, SippSearch::Preference::near),
      neighborhoods_(problem, tables, plan_, random_),
      kept_(Neighborhoods::most_robots) {
  for (std::size_t i = 0; i < plan_.paths.size(); ++i) {
    plan_.occupied.add(static_cast<std::int32_t>(i), plan_.paths[i]);
    cost_ += cost_of(plan_.paths[i]);
    least_cost_ += tables[i].distance(0, problem.agents[i].start);
  }
}

void LargeNeighborhoodSearch::run(std::int64_t iterations) {
  for (std::int64_t before = cost_ + cost_; cost_ < before - before / 50 && !stop_.raised();) {
    before = cost_;
    replan_each_alone();
  }
  std::vector<std::int32_t> agents;
  while (cost_ > least_cost_ && iterations_ != iterations && !stop_.poll_now()) {
    ++iterations_;
    neighborhoods_.draw(agents);
    const std::int64_t before = cost_;
    const std::int64_t expanded = low_level_.expanded();
    replan(agents);
    neighborhoods_.learn(before - cost_, low_level_.expanded() - expanded);
  }
}

// Once over all robots, those that lose most first: takes most of the waits out of a first plan.
void LargeNeighborhoodSearch::replan_each_alone() {
  std::vector<std::int32_t> order(plan_.paths.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [this](std::int32_t a, std::int32_t b) { return neighborhoods_.lost(a) > neighborhoods_.lost(b); });
  for (const std::int32_t agent : order)
    if (neighborhoods_.lost(agent) > 0 && !stop_.poll_now()) replan({agent});
}

// Plans the agents again in this order. False if the old paths are back.
bool LargeNeighborhoodSearch::replan(const std::vector<std::int32_t>& agents) {
  std::int64_t least = 0;   // of the robots that are not planned yet
  std::int64_t budget = 0;  // for these
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const auto agent = static_cast<std::size_t>(agents[i]);
    plan_.occupied.remove(plan_.paths[agent]);
    budget += cost_of(plan_.paths[agent]);
    least += tables_[agent].distance(0, problem_.agents[agent].start);
    kept_[i] = std::move(plan_.paths[agent]);
  }
  std::size_t planned = 0;
  for (; planned < agents.size(); ++planned) {
    const auto agent = static_cast<std::size_t>(agents[planned]);
    least -= tables_[agent].distance(0, problem_.agents[agent].start);
    const auto latest = static_cast<std::int32_t>(std::min<std::int64_t>(budget - least, forever - 1));
    std::vector<Location>& path = plan_.paths[agent];
    const auto result = low_level_.search(problem_.agents[agent], tables_[agent], {}, 0, stop_, path, latest);
    if (result != SippSearch::Result::free) break;
    plan_.occupied.add(agents[planned], path);
    budget -= cost_of(path);
  }
  if (planned == agents.size()) {
    cost_ -= budget;
    return true;
  }
  for (std::size_t i = 0; i < planned; ++i) plan_.occupied.remove(plan_.paths[static_cast<std::size_t>(agents[i])]);
  for (std::size_t i = 0; i < agents.size(); ++i) {
    std::swap(plan_.paths[static_cast<std::size_t>(agents[i])], kept_[i]);
    plan_.occupied.add(agents[i], plan_.paths[static_cast<std::size_t>(agents[i])]);
  }
  return false;
}

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
