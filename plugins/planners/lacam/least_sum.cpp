// SPDX-License-Identifier: MIT
#include "planners/lacam/least_sum.hpp"

#include <algorithm>
#include <functional>

namespace dmrp::planners {

void LeastSum::reach(std::int32_t place, std::vector<bool> underway, std::int64_t cost, std::int32_t next) {
  const std::int64_t in_all = cost + places_[static_cast<std::size_t>(place)].least_before;
  if (in_all >= limit_) return;
  const auto id = static_cast<std::int32_t>(states_.size());
  const auto [known, is_new] = known_.try_emplace({place, underway}, id);
  if (!is_new) {
    if (states_[static_cast<std::size_t>(known->second)].cost <= cost) return;
    known->second = id;
  }
  states_.push_back({place, std::move(underway), cost, next});
  open_.emplace_back(in_all, id);
  std::push_heap(open_.begin(), open_.end(), std::greater<>());
}

std::vector<std::int32_t> LeastSum::run(std::int32_t goal) {
  std::vector<std::vector<std::int32_t>> before(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i)
    for (const std::int32_t after : places_[i].after)
      before[static_cast<std::size_t>(after)].push_back(static_cast<std::int32_t>(i));

  reach(goal, std::vector<bool>(places_[static_cast<std::size_t>(goal)].is_underway.size(), false), 0, -1);
  while (!open_.empty() && !stop_.poll()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    std::int32_t id = open_.back().second;
    open_.pop_back();
    const State state = states_[static_cast<std::size_t>(id)];
    if (known_.at({state.place, state.underway}) != id) continue;  // a cheaper one is known
    if (state.place == 0) {
      std::vector<std::int32_t> way;
      for (; id >= 0; id = states_[static_cast<std::size_t>(id)].next)
        way.push_back(states_[static_cast<std::size_t>(id)].place);
      return way;
    }
    const Place& here = places_[static_cast<std::size_t>(state.place)];
    for (const std::int32_t earlier : before[static_cast<std::size_t>(state.place)]) {
      const Place& from = places_[static_cast<std::size_t>(earlier)];
      std::vector<bool> underway = state.underway;
      std::int64_t step = 0;
      for (std::size_t i = 0; i < underway.size(); ++i) {
        underway[i] = underway[i] || here.is_underway[i] || from.is_underway[i];
        step += underway[i] ? 1 : 0;
      }
      reach(earlier, std::move(underway), state.cost + step, id);
    }
  }
  return {};
}

}  // namespace dmrp::planners
