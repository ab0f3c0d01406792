// SPDX-License-Identifier: MIT
#include "planners/large_agents/prioritized_planning.hpp"

#include <algorithm>
#include <dmrp/toolkit/random.hpp>
#include <numeric>

namespace dmrp::planners {

namespace {

// An order is given up after so many agents for each agent went to its front.
constexpr std::size_t displacements_an_agent = 4;

// Delays after a restart are shorter than this.
constexpr std::uint64_t delay_limit = 16;

}  // namespace

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

}  // namespace dmrp::planners
