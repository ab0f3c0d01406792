// SPDX-License-Identifier: MIT
#include "planners/large_agents/planning.hpp"

#include <algorithm>
#include <cstdint>
#include <dmrp/toolkit/random.hpp>
#include <numeric>
#include <vector>

#include "planners/large_agents/conflict_search.hpp"
#include "planners/large_agents/safe_interval_search.hpp"

namespace dmrp::planners {

namespace {

// The agents of a fleet one after the other, each by SIPP around those before it.
//
// The first order is by distance, nearest goal first. An agent without a path goes to the front of the order, and the
// others are planned again; after too many of these the order is drawn anew, with delays for half of the agents.
class PrioritizedFleet {
 public:
  enum class Result { solved, stopped, restart_limit };

  PrioritizedFleet(const PreparedFleet& prepared, std::uint64_t seed, StopSignal& stop);

  Result run(std::int64_t restart_limit);

  // After Result::solved: one path for each agent.
  const std::vector<std::vector<Location>>& paths() const { return paths_; }
  std::int64_t restarts() const { return restarts_; }
  std::int64_t displaced() const { return displaced_; }
  std::int64_t low_level_expanded() const { return low_level_.expanded(); }

 private:
  void draw_order(std::int64_t restart);
  Result attempt();
  FleetSipp::Result plan(AgentIndex agent, std::int32_t delay);
  Result tighten();

  const PreparedFleet& prepared_;
  std::uint64_t seed_;
  StopSignal& stop_;
  FleetSipp low_level_;
  std::vector<AgentIndex> order_;
  std::vector<std::int32_t> delays_;  // steps for which an agent stays at its start
  std::vector<std::vector<Location>> paths_;
  std::int64_t restarts_ = 0;
  std::int64_t displaced_ = 0;
};

// An order is given up after so many agents for each agent went to its front.
constexpr std::size_t displacements_an_agent = 4;

// Delays after a restart are shorter than this.
constexpr std::uint64_t delay_limit = 16;

PrioritizedFleet::PrioritizedFleet(const PreparedFleet& prepared, std::uint64_t seed, StopSignal& stop)
    : prepared_(prepared), seed_(seed), stop_(stop), low_level_(prepared.fleet), paths_(prepared.fleet.agents.size()) {}

PrioritizedFleet::Result PrioritizedFleet::run(std::int64_t restart_limit) {
  for (restarts_ = 0; restarts_ <= restart_limit; ++restarts_) {
    draw_order(restarts_);
    const Result result = attempt();
    if (result != Result::restart_limit) return result;
  }
  return Result::restart_limit;
}

void PrioritizedFleet::draw_order(std::int64_t restart) {
  order_.resize(paths_.size());
  std::iota(order_.begin(), order_.end(), 0);
  delays_.assign(paths_.size(), 0);
  toolkit::Stream random(seed_, "sipp.fleet", restart);
  random.shuffle(order_);
  if (restart > 0) {
    for (std::int32_t& delay : delays_)
      if (random.below(2) == 0) delay = static_cast<std::int32_t>(random.below(delay_limit));
    return;
  }
  const auto distance = [this](AgentIndex agent) {
    const auto i = static_cast<std::size_t>(agent);
    return prepared_.tables[i].distance(0, prepared_.fleet.agents[i].start);
  };
  std::stable_sort(order_.begin(), order_.end(), [&](AgentIndex a, AgentIndex b) { return distance(a) < distance(b); });
}

PrioritizedFleet::Result PrioritizedFleet::attempt() {
  for (auto& path : paths_) path.clear();
  const std::size_t most = displacements_an_agent * paths_.size();
  std::size_t displaced = 0;
  for (std::size_t i = 0; i < order_.size();) {
    const AgentIndex agent = order_[i];
    const FleetSipp::Result result = plan(agent, delays_[static_cast<std::size_t>(agent)]);
    if (result == FleetSipp::Result::stopped) return Result::stopped;
    if (result == FleetSipp::Result::found) {
      ++i;
      continue;
    }
    if (i == 0 || ++displaced > most) return Result::restart_limit;
    ++displaced_;
    std::rotate(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(i),
                order_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    for (auto& path : paths_) path.clear();
    i = 0;
  }
  return tighten();
}

FleetSipp::Result PrioritizedFleet::plan(AgentIndex agent, std::int32_t delay) {
  const auto i = static_cast<std::size_t>(agent);
  std::vector<Location> path;
  std::vector<PathView> others(paths_.begin(), paths_.end());
  others[i] = {};
  const FleetSipp::Result result = low_level_.search(agent, prepared_.tables[i], others, delay, stop_, path);
  if (result == FleetSipp::Result::found) paths_[i] = std::move(path);
  return result;
}

// Plans each agent again among all others, without its delay, until no path gets shorter.
PrioritizedFleet::Result PrioritizedFleet::tighten() {
  std::size_t unchanged = 0;
  for (std::size_t i = 0; unchanged < paths_.size(); i = (i + 1) % paths_.size()) {
    const std::size_t before = paths_[i].size();
    std::vector<Location> old = paths_[i];
    const FleetSipp::Result result = plan(static_cast<AgentIndex>(i), 0);
    if (result == FleetSipp::Result::stopped) return Result::stopped;
    if (paths_[i].size() >= before) paths_[i] = std::move(old);
    unchanged = paths_[i].size() < before ? 0 : unchanged + 1;
  }
  return Result::solved;
}

}  // namespace

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
