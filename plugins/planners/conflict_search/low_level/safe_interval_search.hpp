// SPDX-License-Identifier: MIT
// safe_interval_search.hpp: the low level over safe intervals (Phillips, Likhachev 2011): equivalent times at a
// location form one interval, represented by its earliest reachable time.
//
// Constraints delimit the intervals, and so do the paths of the other agents (softly, as in SIPPS: Li et al. 2022).
// Between two visits lies one interval without conflicts; each step of a visit is an interval with conflicts; the time
// after an agent has come to rest is one interval with one conflict.
//
// Expansion is partial: a node gets its successors up to the bound, and is expanded again when the bound has risen. An
// agent that may wait long has many successors, most of which are never needed.
#pragma once

#include "planners/conflict_search/low_level/focal_list.hpp"
#include "planners/conflict_search/low_level/low_level.hpp"

namespace dmrp::planners {

class SafeIntervalSearch {
 public:
  explicit SafeIntervalSearch(const GridGraph& graph);

  LowLevelResult search(const LowLevelRequest& request, StopSignal& stop, LowLevelPath& found);

  std::int64_t expanded() const { return expanded_; }

 private:
  using Id = FocalList::Id;
  static constexpr Id none = FocalList::none;

  // Equivalent times at one location, from `first` to before `end`.
  struct Interval {
    std::int32_t first;
    std::int32_t end;
    bool is_allowed;
    std::int32_t conflicts;
  };
  struct Node {
    Location location;
    std::int32_t leg;
    std::int32_t first;  // of the interval
    std::int32_t end;
    std::int32_t t;  // of arrival
    std::int32_t f;  // after a partial expansion: the least f of the successors that are missing
    std::int32_t conflicts;
    std::int32_t turns;
    Id parent;
    Id next;                        // at the same location
    std::int32_t expanded_to = -1;  // f of the successors it has
    std::int32_t fresh_f = -1;      // the f for which the node counts as fresh, or -1
    std::uint8_t heading = GridGraph::no_direction;
    bool waited_at_end = false;  // its last step is a wait at the end of the tour; the path cannot end here then
    bool is_open = false;
    bool is_end = false;  // comes to rest here; `conflicts` include those of resting
  };
  struct Slot {
    std::uint32_t epoch = 0;
    Id first = none;
  };
  // A node under expansion.
  struct Expansion {
    Id id;
    Node from;
    std::int32_t leg;                  // of the next step
    std::int32_t missing_f = forever;  // least f of the successors beyond the bound
  };

  void reset(const LowLevelRequest& request);
  void expand(Id id);
  void move(Expansion& expansion, Direction d);
  void wait(Expansion& expansion);
  void add_successor(Expansion& expansion, Location to, Direction d, const Interval& interval, std::int32_t t,
                     std::int32_t conflicts);
  void offer(const Node& node);
  void offer_end(Id id);
  Interval interval_at(Location location, std::int32_t leg, std::int32_t t) const;
  std::int32_t estimate(std::int32_t leg, Location location, std::int32_t t, bool waited_at_end) const;
  void open(Id id);
  void set_fresh(Id id, std::int32_t f);
  Id& first_at(Location location);
  void extract(Id id, LowLevelPath& found) const;

  const GridGraph& graph_;
  const LowLevelRequest* request_ = nullptr;
  FocalList focal_;
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;  // by location: the last node added there in this search
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
