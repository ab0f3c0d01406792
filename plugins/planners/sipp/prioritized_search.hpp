// SPDX-License-Identifier: MIT
// prioritized_search.hpp: plans robots one after the other, each around the paths of those before it.
//
// The first order is by distance, nearest goal first, so that few robots wait for others that cross their goals late. A
// robot that finds no free path takes one through the robots that are cheapest to displace. These lose their paths and
// go to the end of the order. Each time a robot is displaced its price grows, so robots that are hard to place come
// earlier in time: the search learns the order. After too many displacements it restarts in a random order, with random
// delays for some robots.
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

  // The problem must have no obvious obstruction: all goals can be reached; starts differ, and so do last goals.
  PrioritizedSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed, StopSignal& stop);

  Result run(std::int64_t restart_limit);

  // Plans in the first order only, and gives up when the low level has expanded so many states, and more than until
  // then, since the number of robots without a path was last halved. Result::restart_limit: no plan.
  Result run_once(std::int64_t patience);

  // After Result::solved: one path for each agent.
  std::vector<std::vector<Location>>& paths() { return paths_; }
  // The same paths, by location.
  SafeIntervals& occupied() { return planned_; }
  // After Result::unsolvable: why there is no plan.
  const std::string& obstruction() const { return obstruction_; }
  PrioritizedStatistics statistics() const;

 private:
  enum class Attempt { succeeded, failed, stopped };

  Attempt attempt(std::int64_t restart, std::int64_t patience);
  void begin(std::int64_t restart);
  Attempt tighten();
  SippSearch::Result plan(std::int32_t agent);
  void displace_blockers();
  void remove_path(std::int32_t agent);

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  std::uint64_t seed_;
  StopSignal& stop_;
  SafeIntervals planned_;
  SippSearch low_level_;
  std::vector<std::vector<Location>> paths_;  // empty for a robot without a path
  std::deque<std::int32_t> order_;            // robots to plan
  std::vector<std::int32_t> prices_;          // of displacing a robot
  std::vector<std::int32_t> delays_;          // steps for which a robot stays at its start
  std::vector<Location> path_;
  std::vector<std::int32_t> blockers_;
  std::string obstruction_;
  PrioritizedStatistics statistics_;
};

}  // namespace dmrp::planners
