// SPDX-License-Identifier: MIT
// safe_interval_search.hpp: the least cost path of one agent of a fleet among others whose paths are known, over safe
// intervals (Phillips, Likhachev 2011). A safe interval of a location is a time during which the agent can stand there.
#pragma once

#include <queue>
#include <vector>

#include "planners/large_agents/fleet.hpp"

namespace dmrp::planners {

class FleetSipp {
 public:
  enum class Result { found, none, stopped };

  explicit FleetSipp(const Fleet& fleet) : fleet_(fleet) {}

  // `others`: paths by agent; empty for those that are not obstacles. The agent stays at its start for `delay` steps.
  Result search(AgentIndex agent, const TourTable& table, const std::vector<PathView>& others, std::int32_t delay,
                StopSignal& stop, std::vector<Location>& path);

  std::int64_t expanded() const { return expanded_; }

 private:
  struct Interval {
    std::int32_t from;
    std::int32_t to;  // included
  };
  struct Node {
    Location location;
    std::int32_t leg;
    std::int32_t t;  // of arrival
    std::int32_t interval;
    std::int32_t parent;
  };
  using Entry = std::pair<std::int64_t, std::int32_t>;  // f and lateness in one number, node

  void reset(AgentIndex agent, const TourTable& table, const std::vector<PathView>& others);
  const std::vector<Interval>& intervals(Location location);
  bool is_blocked(Location from, Location to, std::int32_t t) const;
  void expand(std::int32_t id);
  void offer(Location location, std::int32_t leg, std::int32_t t, std::int32_t interval, std::int32_t parent);
  void write(std::int32_t id, std::vector<Location>& path) const;

  const Fleet& fleet_;
  AgentIndex agent_ = -1;
  const TourTable* table_ = nullptr;
  const std::vector<PathView>* others_ = nullptr;
  std::int32_t rest_from_ = 0;                                    // all others rest from this time on
  std::vector<std::vector<Interval>> intervals_;                  // by location; empty: not computed yet
  std::vector<bool> is_known_;                                    // by location
  std::vector<std::vector<std::vector<std::int32_t>>> earliest_;  // by leg, location and interval
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
