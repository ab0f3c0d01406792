// SPDX-License-Identifier: MIT
// prioritized_search.hpp: robots planned one after the other, each among those before it.
#pragma once

#include <cstdint>
#include <vector>

#include "safe_interval_search.hpp"

namespace dmrp::planners {

struct PrioritizedStatistics {
  std::int64_t restarts = 0;
  std::int64_t displaced = 0;
  std::int64_t low_level_expanded = 0;
};

class PrioritizedSearch {
 public:
  enum class Result { solved, stopped, restart_limit };

  PrioritizedSearch(const Problem& problem, const std::vector<TourTable>& tables, std::uint64_t seed, StopSignal& stop);

  Result run(std::int64_t restart_limit);

  // After Result::solved: a path an agent.
  std::vector<std::vector<Location>>& paths() { return paths_; }
  PrioritizedStatistics statistics() const;

 private:
  enum class Attempt { solved, stopped, given_up };

  void draw_order(std::int64_t restart);
  Attempt attempt();
  void take_back(std::int32_t agent);

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  std::uint64_t seed_;
  StopSignal& stop_;
  SafeIntervals planned_;
  SafeIntervalSearch low_level_;
  std::vector<std::vector<Location>> paths_;  // empty for a robot that is not planned
  std::vector<std::int32_t> order_;           // robots to be planned, the next one last
  std::vector<std::int32_t> prices_;          // what it costs to displace a robot: how often that was needed
  std::vector<std::int32_t> in_the_way_;
  std::vector<Location> path_;
  PrioritizedStatistics statistics_;
};

}  // namespace dmrp::planners
