// SPDX-License-Identifier: MIT
#include "planners/sipp/prioritized_search.hpp"

#include <algorithm>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <numeric>

#include "planners/mapf/solvability.hpp"

namespace dmrp::planners {

namespace {

// An attempt fails after this many displacements for each robot.
constexpr std::int64_t displacements_a_robot = 10;

// After a restart every second robot has a delay of fewer steps than this. Where two robots have to give way to each
// other no order helps, but a delay often does.
constexpr std::uint64_t delay_limit = 8;

// The limit of joint positions for the proof that there is no plan.
constexpr std::size_t joint_state_limit = 300'000;

}  // namespace

PrioritizedSearch::PrioritizedSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed,
                                     StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      seed_(seed),
      stop_(stop),
      planned_(problem.graph),
      low_level_(problem.graph, planned_),
      paths_(problem.agents.size()) {}

PrioritizedSearch::Result PrioritizedSearch::run(std::int64_t restart_limit) {
  for (std::int64_t restart = 0; restart <= restart_limit; ++restart) {
    const Attempt result = attempt(restart, std::numeric_limits<std::int64_t>::max());
    if (result == Attempt::succeeded) return Result::solved;
    if (result == Attempt::stopped) return Result::stopped;
    if (restart > 0) continue;
    const auto found = find_joint_obstruction(problem_, joint_state_limit, stop_);
    if (found) return obstruction_ = *found, Result::unsolvable;
  }
  return Result::restart_limit;
}

PrioritizedSearch::Result PrioritizedSearch::run_once(std::int64_t patience) {
  const Attempt result = attempt(0, patience);
  if (result == Attempt::succeeded) return Result::solved;
  return result == Attempt::stopped ? Result::stopped : Result::restart_limit;
}

// Plans all robots, in the first order or in a random one.
PrioritizedSearch::Attempt PrioritizedSearch::attempt(std::int64_t restart, std::int64_t patience) {
  begin(restart);
  const std::int64_t limit =
      statistics_.displaced + displacements_a_robot * static_cast<std::int64_t>(problem_.agents.size());
  std::size_t next_half = order_.size() / 2;
  const std::int64_t began_at = low_level_.expanded();
  std::int64_t halved_at = began_at;
  while (!order_.empty()) {
    if (order_.size() <= next_half) {
      next_half = order_.size() / 2;
      halved_at = low_level_.expanded();
    }
    const std::int32_t agent = order_.front();
    order_.pop_front();
    const SippSearch::Result result = plan(agent);
    if (result == SippSearch::Result::stopped) return Attempt::stopped;
    if (result == SippSearch::Result::none || statistics_.displaced > limit ||
        low_level_.expanded() - halved_at > std::max(patience, halved_at - began_at))
      return Attempt::failed;
  }
  return restart == 0 ? Attempt::succeeded : tighten();
}

// Removes the cost of delays: replans each robot among all others without a delay, until no path gets shorter.
PrioritizedSearch::Attempt PrioritizedSearch::tighten() {
  std::size_t unchanged = 0;
  for (std::size_t i = 0; unchanged < paths_.size(); i = (i + 1) % paths_.size()) {
    planned_.remove(paths_[i]);
    const auto result = low_level_.search(problem_.agents[i], tables_[i], {}, 0, stop_, path_);
    const bool gains = result == SippSearch::Result::free && path_.size() < paths_[i].size();
    if (gains) paths_[i] = path_;
    planned_.add(static_cast<std::int32_t>(i), paths_[i]);
    if (result == SippSearch::Result::stopped) return Attempt::stopped;
    unchanged = gains ? 0 : unchanged + 1;
  }
  return Attempt::succeeded;
}

void PrioritizedSearch::begin(std::int64_t restart) {
  statistics_.restarts = restart;
  for (std::size_t i = 0; i < paths_.size(); ++i) remove_path(static_cast<std::int32_t>(i));
  prices_.assign(paths_.size(), 1);
  delays_.assign(paths_.size(), 0);
  order_.resize(paths_.size());
  std::iota(order_.begin(), order_.end(), 0);

  toolkit::Stream random(seed_, "sipp.order", restart);
  random.shuffle(order_);
  if (restart > 0) {
    for (std::int32_t& delay : delays_)
      if (random.below(2) == 0) delay = static_cast<std::int32_t>(random.below(delay_limit));
    return;
  }
  const auto distance = [this](std::int32_t agent) {
    const auto i = static_cast<std::size_t>(agent);
    return tables_[i].distance(0, problem_.agents[i].start);
  };
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
}

SippSearch::Result PrioritizedSearch::plan(std::int32_t agent) {
  const auto i = static_cast<std::size_t>(agent);
  const auto result = low_level_.search(problem_.agents[i], tables_[i], prices_, delays_[i], stop_, path_);
  if (result != SippSearch::Result::free && result != SippSearch::Result::displacing) return result;
  if (result == SippSearch::Result::displacing) displace_blockers();
  paths_[i] = path_;
  planned_.add(agent, paths_[i]);
  return result;
}

void PrioritizedSearch::displace_blockers() {
  planned_.list_conflicts(path_, blockers_);
  for (const std::int32_t other : blockers_) {
    remove_path(other);
    order_.push_back(other);
    ++prices_[static_cast<std::size_t>(other)];
  }
  statistics_.displaced += static_cast<std::int64_t>(blockers_.size());
}

void PrioritizedSearch::remove_path(std::int32_t agent) {
  std::vector<Location>& path = paths_[static_cast<std::size_t>(agent)];
  planned_.remove(path);
  path.clear();
}

PrioritizedStatistics PrioritizedSearch::statistics() const {
  PrioritizedStatistics statistics = statistics_;
  statistics.low_level_expanded = low_level_.expanded();
  return statistics;
}

}  // namespace dmrp::planners
