// SPDX-License-Identifier: MIT
// least_sum.hpp: the way with the least sum of costs in a graph of configurations.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// The cost of a robot is the time from which it rests for good. That depends on what comes later, so the search goes
// back in time, from the goal: its states are a configuration and the set of robots that do not rest any more. Each
// step back costs one for each robot in the set. A* with the cost from the start in which rest that is broken later
// costs nothing: it is never higher.
class LeastSum {
 public:
  struct Place {
    std::int64_t least_before = 0;    // lower bound of the cost from the start to here
    std::vector<bool> is_underway;    // by robot: not at the end of its tour
    std::vector<std::int32_t> after;  // places one step later
  };

  // Looks for ways that cost less than `limit`.
  LeastSum(std::int64_t limit, StopSignal& stop) : limit_(limit), stop_(stop) {}

  // Place 0 is the start.
  void add(Place place) { places_.push_back(std::move(place)); }

  // The places from the start to the goal; empty if no way costs less than the limit, or if `stop` was raised.
  std::vector<std::int32_t> run(std::int32_t goal);

 private:
  struct State {
    std::int32_t place;
    std::vector<bool> underway;  // robots that move or wait at some time from here on
    std::int64_t cost;           // from here to the goal
    std::int32_t next;           // the state one step later, or -1
  };
  using Key = std::pair<std::int32_t, std::vector<bool>>;

  void reach(std::int32_t place, std::vector<bool> underway, std::int64_t cost, std::int32_t next);

  std::int64_t limit_;
  StopSignal& stop_;
  std::vector<Place> places_;
  std::vector<State> states_;
  std::map<Key, std::int32_t> known_;
  std::vector<std::pair<std::int64_t, std::int32_t>> open_;  // a heap by cost in all
};

}  // namespace dmrp::planners
