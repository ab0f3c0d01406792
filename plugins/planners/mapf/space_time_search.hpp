// SPDX-License-Identifier: MIT
// space_time_search.hpp: the low level: a path for one agent under constraints, with few conflicts with the others, of
// a cost within a bound of the least.
//
// Focal search (Pearl, Kim 1982; in this use Barer et al. 2014) over (location, time, leg): OPEN by f, the least cost
// of a path through a node; FOCAL, the nodes of OPEN within the bound, by conflicts. With suboptimality 1 it is A* with
// ties broken by conflicts: a path of least cost, and of these one with fewest conflicts.
#pragma once

#include <cstdint>
#include <vector>

#include "conflict_table.hpp"
#include "constraint.hpp"
#include "tour_table.hpp"

namespace dmrp::planners {

class SpaceTimeSearch {
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
    std::int32_t conflicts = 0;    // agents met, counted once a step
  };

  enum class Result { found, none, stopped };

  explicit SpaceTimeSearch(const GridGraph& graph) : graph_(graph) {}

  // Later events: after the last constraint and the last move of the others time is not told apart.
  Result search(const Request& request, StopSignal& stop, Found& found);

  std::int64_t expanded() const { return expanded_; }

 private:
  using NodeId = std::uint32_t;
  static constexpr NodeId no_node = ~NodeId{0};

  struct Node {
    std::uint64_t key;  // where, when and in which leg: equal for nodes of which only the best is kept
    NodeId parent;
    Location location;
    std::int32_t t;
    std::int32_t leg;
    std::int32_t f;
    std::int32_t conflicts;
    std::int32_t turns;
    std::uint8_t heading;
    bool is_open;
    bool was_expanded;
    bool is_end;  // stays there for good; its conflicts are those until then, too
  };
  struct FocalEntry {
    std::uint64_t order;
    NodeId node;
  };
  struct Level {                  // of nodes of one f
    std::int32_t fresh = 0;       // open ones that were never expanded
    std::vector<NodeId> waiting;  // those that are not in FOCAL yet
  };

  void reset(const Request& request);
  bool advance_bound();
  void expand(NodeId id);
  void offer(Node node);
  void offer_end(NodeId id);
  bool waits_at_the_end(const Node& node) const;
  bool can_end(const Node& node) const;
  std::int32_t estimate(std::int32_t leg, Location location, std::int32_t t, bool waited_at_end) const;
  bool keeps_landmarks(Location location, std::int32_t t) const;
  std::int32_t columns_and_rows_between(Location a, Location b) const;
  std::uint64_t order_of(const Node& node) const;
  void open(NodeId id);
  void push_focal(NodeId id);
  NodeId pop_focal();
  NodeId& slot_of(std::uint64_t key);
  void grow_slots();
  void extract(NodeId id, Found& found) const;

  const GridGraph& graph_;
  const Request* request_ = nullptr;
  std::int32_t horizon_ = 0;      // from here on time is not told apart
  std::int32_t least_f_ = 0;      // of the first level
  std::int32_t bound_level_ = 0;  // the lower bound, as a level
  std::int32_t focal_level_ = 0;  // the last level that is in FOCAL
  std::vector<Node> nodes_;
  std::vector<FocalEntry> focal_;  // a heap
  std::vector<Level> levels_;
  std::int32_t level_count_ = 0;
  struct Slot {
    std::uint32_t epoch = 0;
    NodeId node = no_node;
  };
  std::vector<Slot> slots_ = std::vector<Slot>(1024);  // open addressing by key
  std::uint32_t epoch_ = 0;
  std::int64_t expanded_ = 0;
};

}  // namespace dmrp::planners
