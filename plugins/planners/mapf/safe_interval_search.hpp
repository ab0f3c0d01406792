// SPDX-License-Identifier: MIT
// safe_interval_search.hpp: the low level: a path for one agent under constraints, with few conflicts with the others,
// of a cost within a bound of the least.
//
// Focal search (Pearl, Kim 1982; in this use Barer et al. 2014) over safe intervals (Phillips, Likhachev 2011): the
// times at a location that are alike form one interval, whose earliest time stands for all of them. Constraints bound
// the intervals, and so do the paths of others (soft, as in SIPPS: Li et al. 2022): between two visits of others one
// interval is free of conflicts, at a visit there is one of a single step. OPEN is ordered by f, the least cost of a
// path through a node; FOCAL are the nodes of OPEN within the bound, by conflicts. With suboptimality 1 it is A* with
// ties broken by conflicts: a path of least cost, and of these one with fewest conflicts.
//
// A node is expanded as far as the bound goes, and again when it has moved on: whoever may wait long has many
// successors, most of them never of use.
#pragma once

#include <cstdint>
#include <vector>

#include "conflict_table.hpp"
#include "constraint.hpp"
#include "tour_table.hpp"

namespace dmrp::planners {

class SafeIntervalSearch {
 public:
  struct Request {
    const Agent& agent;
    const TourTable& table;
    const ConstraintTable& constraints;
    const ConflictTable& others;
    double suboptimality = 1;
    double slack = 0;              // the path may cost this more than suboptimality times the lower bound
    std::int32_t lower_bound = 0;  // of the agent's cost under these constraints, as far as it is known
  };

  struct Found {
    std::vector<Location> path;
    std::int32_t lower_bound = 0;  // no path under the constraints costs less; at least the request's
    std::int32_t conflicts = 0;    // visits of others met
  };

  enum class Result { found, none, stopped };

  explicit SafeIntervalSearch(const GridGraph& graph) : graph_(graph) {}

  Result search(const Request& request, StopSignal& stop, Found& found);

  std::int64_t expanded() const { return expanded_; }

 private:
  using Id = std::uint32_t;
  static constexpr Id none = ~Id{0};

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
    Id next;                        // in the same interval
    std::int32_t expanded_to = -1;  // f of the successors it has
    std::int32_t fresh_level = -1;  // it counts as fresh there
    std::uint8_t heading = GridGraph::no_direction;
    bool waited_at_end = false;  // its last step is a wait where the path could have ended: it cannot end here then
    bool is_open = false;
    bool is_end = false;  // stays there for good; its conflicts are those until then, too
  };
  struct FocalEntry {
    std::uint64_t order;
    Id node;
  };
  struct Level {              // of nodes of one f
    std::int32_t fresh = 0;   // open ones that nobody reached as early before
    std::vector<Id> waiting;  // those that are not in FOCAL yet
  };
  struct Slot {
    std::uint32_t epoch = 0;
    Id node = none;
  };

  void reset(const Request& request);
  bool advance_bound();
  void expand(Id id);
  void move(Id id, Direction d, std::int32_t& left_out);
  void wait(Id id, std::int32_t& left_out);
  void successor(Id id, Location to, Direction d, std::int32_t leg, const Interval& interval, std::int32_t t,
                 std::int32_t conflicts, std::int32_t& left_out);
  void offer(const Node& node);
  void offer_end(Id id);
  Interval interval_at(Location location, std::int32_t leg, std::int32_t t) const;
  bool can_end(const Node& node) const;
  std::int32_t estimate(std::int32_t leg, Location location, std::int32_t t, bool waited_at_end) const;
  std::uint64_t order_of(const Node& node) const;
  Level& level_of(std::int32_t f);
  void open(Id id, bool is_fresh);
  void set_fresh(Id id, std::int32_t level);
  void push_focal(Id id);
  Id pop_focal();
  Id& slot_of(const Node& node);
  void grow_slots();
  void extract(Id id, Found& found) const;

  const GridGraph& graph_;
  const Request* request_ = nullptr;
  std::int32_t least_f_ = 0;      // of the first level
  std::int32_t bound_level_ = 0;  // the lower bound, as a level
  std::int32_t focal_level_ = 0;  // the last level that is in FOCAL
  std::vector<Node> nodes_;
  std::vector<FocalEntry> focal_;  // a heap
  std::vector<Level> levels_;
  std::int32_t level_count_ = 0;
  std::vector<Slot> slots_ = std::vector<Slot>(1024);  // open addressing by interval: the first of its nodes
  std::size_t slots_used_ = 0;
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
