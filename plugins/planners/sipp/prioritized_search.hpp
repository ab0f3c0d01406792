// SPDX-License-Identifier: MIT
// prioritized_search.hpp: robots planned one after the other, each among the paths of those before it.
//
// The first order is by distance, the nearest goal first, so that few robots wait for those that cross their goals
// late. A robot that finds no way is planned through others: through those that are cheapest to displace. They lose
// their paths and go to the end of the order; all others keep theirs. With every time the price of a robot grows, so
// that those who are hard to place come before the others sooner or later: the order is learned. When too many were
// displaced all begin anew, in an order drawn at random, and some of them later than they could.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "planners/sipp/sipp_search.hpp"

namespace dmrp::planners {

struct PrioritizedStatistics {
  std::int64_t restarts = 0;
  std::int64_t displaced = 0;
  std::int64_t low_level_expanded = 0;
};

class PrioritizedSearch {
 public:
  enum class Result { solved, unsolvable, restart_limit, stopped };

  // The problem has no obvious obstruction: all goals can be reached, starts and last goals differ.
  PrioritizedSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed, StopSignal& stop);

  Result run(std::int64_t restart_limit);

  // After Result::solved: a path an agent.
  std::vector<std::vector<Location>>& paths() { return paths_; }
  // Where they are, path by path.
  SafeIntervals& occupied() { return planned_; }
  // After Result::unsolvable.
  const std::string& obstruction() const { return obstruction_; }
  PrioritizedStatistics statistics() const;

 private:
  enum class Attempt { succeeded, failed, stopped };

  Attempt attempt(std::int64_t restart);
  void begin(std::int64_t restart);
  Attempt tighten();
  SippSearch::Result plan(std::int32_t agent);
  void displace_those_in_the_way();
  void take_back(std::int32_t agent);

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  std::uint64_t seed_;
  StopSignal& stop_;
  SafeIntervals planned_;
  SippSearch low_level_;
  std::vector<std::vector<Location>> paths_;  // empty for a robot that is not planned
  std::deque<std::int32_t> order_;            // robots to be planned
  std::vector<std::int32_t> prices_;          // of displacing a robot
  std::vector<std::int32_t> delays_;          // steps that a robot stays where it starts
  std::vector<Location> path_;
  std::vector<std::int32_t> in_the_way_;
  std::string obstruction_;
  PrioritizedStatistics statistics_;
};

}  // namespace dmrp::planners
