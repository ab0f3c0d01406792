// SPDX-License-Identifier: MIT
// single_search.hpp: a path of one agent of a fleet under bans, with few conflicts with the others: focal search over
// (location, time, leg), as conflict_search/low_level/space_time_search.hpp.
#pragma once

#include <unordered_map>

#include "planners/conflict_search/low_level/focal_list.hpp"
#include "planners/large_agents/ban.hpp"

namespace dmrp::planners {

struct SingleRequest {
  AgentIndex agent;
  const TourTable& table;
  const BanTable& bans;
  const std::vector<PathView>& others;  // by agent; empty for those that do not matter
  double suboptimality = 1;
  std::int32_t lower_bound = 0;  // known lower bound of the cost under these bans
};

struct SinglePath {
  std::vector<Location> locations;
  std::int32_t lower_bound = 0;  // no path under the bans costs less
};

class SingleSearch {
 public:
  enum class Result { found, none, stopped };

  explicit SingleSearch(const Fleet& fleet) : fleet_(fleet) {}

  Result search(const SingleRequest& request, StopSignal& stop, SinglePath& found);

  std::int64_t expanded() const { return expanded_; }

 private:
  using Id = FocalList::Id;
  static constexpr Id none = FocalList::none;

  struct Node {
    Location location = nowhere;
    std::int32_t leg = 0;
    std::int32_t t = 0;
    std::int32_t f = 0;
    std::int32_t conflicts = 0;
    std::int32_t turns = 0;
    Id parent = none;
    std::uint8_t heading = GridGraph::no_direction;
    bool waited_at_end = false;  // its last step is a wait at the end of the tour; the path cannot end here then
    bool is_open = false;
    bool is_fresh = false;
    bool is_end = false;  // comes to rest here; `conflicts` include those of resting
  };

  void reset(const SingleRequest& request);
  void expand(Id id);
  void offer(Node node);
  void offer_end(Id id);
  void open(const Node& node);
  void close(Id id);
  std::int32_t least_cost_by_way_of(const Node& node) const;
  std::int32_t count_conflicts(Location from, Location to, std::int32_t t) const;

  const Fleet& fleet_;
  const SingleRequest* request_ = nullptr;
  const Agent* agent_ = nullptr;
  std::int32_t others_rest_from_ = 0;
  std::int32_t horizon_ = 0;  // from here on times are not distinguished
  FocalList focal_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, Id> best_;  // by place, time and leg; never iterated over
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
