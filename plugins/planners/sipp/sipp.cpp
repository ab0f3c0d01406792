// SPDX-License-Identifier: MIT
#include "sipp.hpp"

#include "../mapf/solvability.hpp"
#include "../mapf/straighten.hpp"
#include "prioritized_search.hpp"

namespace dmrp::planners {

namespace {

// The most joint positions that a proof that there is no plan visits.
constexpr std::size_t joint_state_limit = 300'000;

// What taking turns out may cost, beside half of what planning did.
constexpr std::int64_t straightening_states_a_robot = 100;

}  // namespace

Descriptor Sipp::describe() {
  return Descriptor("dmrp.planner.sipp", "Prioritized SIPP", "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .summary("robots planned one after the other in the safe intervals that those before leave")
      .source(
          "Phillips, Likhachev: SIPP: Safe interval path planning for dynamic environments, ICRA 2011; displacing "
          "robots by SIPPS: Li et al.: MAPF-LNS2, AAAI 2022")
      .connectivity(DMRP_CONNECTIVITY_4);
}

Status Sipp::start(const World&, std::uint64_t seed) {
  seed_ = seed;
  return Status::ok;
}

Status Sipp::plan(const PlanningProblem& host_problem, PlanSink& sink) {
  const Problem problem = make_problem(host_problem, true);
  StopSignal stop([this] { return should_stop(); });
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
  auto result = search.attempt(0);
  std::optional<std::string> obstruction;
  if (result == PrioritizedSearch::Result::given_up)
    obstruction = find_joint_obstruction(problem, joint_state_limit, stop);
  for (std::int64_t i = 1; i <= restarts && result == PrioritizedSearch::Result::given_up && !obstruction; ++i)
    result = search.attempt(i);
  const PrioritizedStatistics statistics = search.statistics();
  sink.statistic("low_level_expanded", static_cast<double>(statistics.low_level_expanded));
  sink.statistic("restarts", static_cast<double>(statistics.restarts));
  sink.statistic("displaced", static_cast<double>(statistics.displaced));
  if (obstruction) {
    set_error(*obstruction);
    return Status::no_solution;
  }
  if (result != PrioritizedSearch::Result::solved) {
    set_error(result == PrioritizedSearch::Result::stopped
                  ? "stopped by the host"
                  : "no plan after restarts = " + std::to_string(*restarts) + " new orders");
    return Status::timeout;
  }
  const auto robots = static_cast<std::int64_t>(problem.agents.size());
  straighten(problem, *tables, search.paths(),
             straightening_states_a_robot * robots + statistics.low_level_expanded / 2, stop);
  double cost = 0;
  for (const auto& path : search.paths()) cost += cost_of(path);
  sink.statistic("cost", cost);
  const std::vector<PathView> views(search.paths().begin(), search.paths().end());
  write_paths(host_problem, problem, views, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
