// SPDX-License-Identifier: MIT
#include "planners/pibt/pibt.hpp"

#include <algorithm>

#include "planners/mapf/straighten.hpp"
#include "planners/pibt/pibt_step.hpp"

namespace dmrp::planners {

namespace {

// The steps that each robot has waited for its next progress: a replan keeps the priority that it has earned.
std::vector<std::int32_t> steps_waited(const PlanningProblem& host_problem, const Problem& problem) {
  std::vector<std::int32_t> steps;
  for (const Agent& agent : problem.agents) {
    const std::int64_t waited = host_problem.robots[agent.robot].waiting_ns / host_problem.step_duration_ns;
    steps.push_back(static_cast<std::int32_t>(std::clamp<std::int64_t>(waited, 0, forever)));
  }
  return steps;
}

// The configurations from the start to rest; without rest at the end after `steps` steps or a stop.
std::vector<Configuration> run_pibt(const Preparation& prepared, std::vector<std::int32_t> steps_underway,
                                    std::int64_t steps, std::uint64_t seed, StopSignal& stop) {
  const auto agents = static_cast<std::int32_t>(prepared.problem.agents.size());
  PibtStep pibt(prepared.problem, prepared.tables);
  const Priorities priorities(prepared.problem, prepared.tables);
  toolkit::Stream random(seed, "pibt.ties");
  std::vector<Configuration> configurations = {start_configuration(prepared.problem)};
  std::vector<std::int32_t> order;
  for (std::int64_t step = 0; step < steps && !stop.poll_now(); ++step) {
    const Configuration& now = configurations.back();
    bool all_rest = true;
    for (std::int32_t agent = 0; agent < agents; ++agent) {
      const bool rests = pibt.rests(now, agent);
      std::int32_t& steps = steps_underway[static_cast<std::size_t>(agent)];
      steps = rests ? 0 : steps + 1;
      all_rest = all_rest && rests;
    }
    if (all_rest) break;
    priorities.sort(steps_underway, order);
    Configuration next;
    if (!pibt.step(now, order, {}, random, next)) break;
    configurations.push_back(std::move(next));
  }
  return configurations;
}

}  // namespace

Descriptor Pibt::describe() {
  return describe_planner("dmrp.planner.pibt", "PIBT", "1.0.0")
      .flags(DMRP_FLAG_WINDOWED)
      .summary("all robots step by step, by priority; the fastest for thousands of robots, with expensive plans")
      .source(
          "Okumura, Machida, Defago, Tamura: Priority inheritance with backtracking for iterative multi-agent path "
          "finding, Artificial Intelligence 310, 2022; swap: Okumura: Improving LaCAM for scalable eventually optimal "
          "multi-agent pathfinding, IJCAI 2023");
}

Status Pibt::solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop, PlanSink& sink) {
  const std::uint32_t window_steps = host_problem.window_steps;
  if (window_steps == 0) sink.statistic("lower_bound", prepared.lower_bound());
  const std::vector<Configuration> configurations =
      run_pibt(prepared, steps_waited(host_problem, prepared.problem), window_steps > 0 ? window_steps : *step_limit,
               seed(), stop);
  std::vector<const Configuration*> sequence;
  for (const Configuration& configuration : configurations) sequence.push_back(&configuration);
  std::vector<std::vector<Location>> paths = paths_of(sequence, prepared.tables);
  if (window_steps > 0) {
    if (configurations.size() <= window_steps && stop.raised()) return fail(Status::timeout, "stopped by the host");
    write_paths(host_problem, prepared.problem, {paths.begin(), paths.end()}, sink);
    return Status::ok;
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (prepared.tables[i].distance(configurations.back().legs[i], configurations.back().locations[i]) == 0) continue;
    return fail(Status::timeout, stop.raised()
                                     ? "stopped by the host"
                                     : "robots are not at rest after " + std::to_string(configurations.size() - 1) +
                                           " steps (step_limit = " + std::to_string(*step_limit) + ")");
  }
  const std::int64_t moves = sum_of_costs(paths);
  sink.statistic("cost", static_cast<double>(moves));
  straighten(prepared.problem, prepared.tables, paths, straightening_limit(paths.size(), moves), stop);
  write_paths(host_problem, prepared.problem, {paths.begin(), paths.end()}, sink);
  return Status::ok;
}

}  // namespace dmrp::planners
