// SPDX-License-Identifier: MIT
// prioritized_planning.hpp: the agents of a fleet one after the other, each by SIPP around those before it.
//
// The first order is by distance, nearest goal first. An agent without a path goes to the front of the order, and the
// others are planned again; after too many of these the order is drawn anew, with delays for half of the agents.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/large_agents/safe_interval_search.hpp"

namespace dmrp::planners {

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

}  // namespace dmrp::planners
