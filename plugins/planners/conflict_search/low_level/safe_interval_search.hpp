// SPDX-License-Identifier: MIT
// safe_interval_search.hpp: the low level over safe intervals (Phillips, Likhachev 2011): the times at a location that
// are alike form one interval, whose earliest time stands for all of them.
//
// Constraints bound the intervals, and so do the paths of others (soft, as in SIPPS: Li et al. 2022): between two
// visits of others one interval is free of conflicts, each step of a visit is an interval of its own with conflicts,
// and where somebody rests for good that is one interval with one conflict.
//
// A node is expanded as far as the bound goes, and again when it has moved on: whoever may wait long has many
// successors, most of them never of use.
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

  // Times from `first` to before `end` at one location that are alike.
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
    std::int32_t f;  // or, where a part of the successors was left out, their least f
    std::int32_t conflicts;
    std::int32_t turns;
    Id parent;
    Id next;                        // at the same location
    std::int32_t expanded_to = -1;  // f of the successors it has
    std::int32_t fresh_f = -1;      // it counts as fresh there; or -1
    std::uint8_t heading = GridGraph::no_direction;
    bool waited_at_end = false;  // its last step is a wait where the path could have ended: it cannot end here then
    bool is_open = false;
    bool is_end = false;  // stays there for good; its conflicts are those until then, too
  };
  // What the expansion of a node is about.
  struct Expansion {
    Id id;
    Node from;
    std::int32_t leg;                 // of the next step
    std::int32_t left_out = forever;  // least f of the successors beyond the bound
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
  struct Slot {
    std::uint32_t epoch = 0;
    Id first = none;
  };
  std::vector<Slot> slots_;  // by location: the last node added there, if it is of this search
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
