// SPDX-License-Identifier: MIT
#include "prioritized_search.hpp"

#include <algorithm>
#include <dmrp/toolkit/random.hpp>
#include <cstdlib>
#include <cstdio>
#include <numeric>

namespace dmrp::planners {

static int knob(const char* name, int fallback) { const char* v = std::getenv(name); return v ? std::atoi(v) : fallback; }

PrioritizedSearch::PrioritizedSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed,
                                     StopSignal& stop)
    : problem_(problem),
      tables_(tables),
      seed_(seed),
      stop_(stop),
      planned_(problem.graph.location_count()),
      low_level_(problem.graph, planned_),
      paths_(problem.agents.size()) {}

PrioritizedSearch::Result PrioritizedSearch::run(std::int64_t restart_limit) {
  for (std::int64_t restart = 0; restart <= restart_limit; ++restart) {
    statistics_.restarts = restart;
    draw_order(restart);
    const Attempt result = attempt();
    if (result == Attempt::solved) return Result::solved;
    if (result == Attempt::stopped) return Result::stopped;
    for (std::size_t i = 0; i < paths_.size(); ++i) take_back(static_cast<std::int32_t>(i));
  }
  return Result::restart_limit;
}

void PrioritizedSearch::draw_order(std::int64_t restart) {
  order_.resize(problem_.agents.size());
  std::iota(order_.begin(), order_.end(), 0);
  static const int mode = knob("ORDER", 0);
  toolkit::Stream stream(seed_, "sipp.order", restart);
  stream.shuffle(order_);
  if (mode == 1 || (mode == 0 && restart == 0)) {
    const auto distance = [&](std::int32_t agent) {
      const auto i = static_cast<std::size_t>(agent);
      return tables_[i].distance(0, problem_.agents[i].start);
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
  }
  if (mode == 3) {
    const auto distance = [&](std::int32_t agent) {
      const auto i = static_cast<std::size_t>(agent);
      return tables_[i].distance(0, problem_.agents[i].start);
    };
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::int32_t a, std::int32_t b) { return distance(a) > distance(b); });
  }
  prices_.assign(order_.size(), 1);
}

PrioritizedSearch::Attempt PrioritizedSearch::attempt() {
  static const int budget_factor = knob("BUDGET", 20);
  static const int displaced_last = knob("LAST", 0);
  static const int growth = knob("GROWTH", 1);
  std::int64_t displaced = 0;
  const std::int64_t limit = budget_factor * static_cast<std::int64_t>(order_.size());
  while (!order_.empty()) {
    const std::int32_t agent = order_.back();
    const auto who = static_cast<std::size_t>(agent);
    order_.pop_back();
    const auto result =
        low_level_.search(problem_.agents[who], tables_[who], budget_factor ? std::span<const std::int32_t>(prices_) : std::span<const std::int32_t>(), stop_, path_);
    if (result == SafeIntervalSearch::Result::stopped) return Attempt::stopped;
    if (result == SafeIntervalSearch::Result::none) return Attempt::given_up;
    if (result == SafeIntervalSearch::Result::displacing) {
      planned_.list_conflicts(path_, in_the_way_);
      if (displaced > limit) return Attempt::given_up;
      for (const std::int32_t other : in_the_way_) {
        take_back(other);
        prices_[static_cast<std::size_t>(other)] += growth;
        if (displaced_last) order_.insert(order_.begin(), other); else
        order_.push_back(other);
        ++displaced;
        ++statistics_.displaced;
      }
    }
    paths_[who] = path_;
    planned_.add(agent, paths_[who]);
  }
  return Attempt::solved;
}

void PrioritizedSearch::take_back(std::int32_t agent) {
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
