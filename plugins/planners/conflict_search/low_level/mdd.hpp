// SPDX-License-Identifier: MIT
// mdd.hpp: multi-valued decision diagrams (Sharon et al. 2013): all paths of least cost of one agent under its
// constraints, as the places where it can be at each time; and a cache of them.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "planners/conflict_search/low_level/constraint.hpp"
#include "planners/mapf/stop_signal.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

class Mdd {
 public:
  struct Node {
    Location location;
    std::int32_t leg;
  };

  // Empty if there is no path of this cost, or if `stop` was raised. `cost` must not exceed the least cost.
  Mdd(const GridGraph& graph, const Agent& agent, const TourTable& table, const ConstraintTable& constraints,
      std::int32_t cost, StopSignal* stop = nullptr);

  // Whether the agent can be at its goal one step early and wait there, without being allowed to come to rest so early.
  // A longer path can then reach the last node by a way that is not in the MDD; this holds for no other node.
  bool may_wait_at_end() const { return may_wait_at_end_; }

  bool is_empty() const { return nodes_.empty(); }
  std::size_t node_count() const { return nodes_.size(); }
  std::int32_t cost() const { return static_cast<std::int32_t>(level_begin_.size()) - 2; }

  // The nodes at a time up to cost(). Each is on at least one path.
  std::span<const Node> level(std::int32_t t) const {
    assert(t >= 0 && t <= cost());
    const auto at = static_cast<std::size_t>(t);
    return {nodes_.data() + level_begin_[at], nodes_.data() + level_begin_[at + 1]};
  }

  // Whether every path of least cost is at `location` at time t, or rests there by then.
  bool must_be_at(Location location, std::int32_t t) const;

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> level_begin_;
  bool may_wait_at_end_ = false;
};

// MDDs by agent and set of constraints.
class MddCache {
 public:
  MddCache(const Problem& problem, const std::vector<TourTable>& tables, StopSignal* stop = nullptr)
      : problem_(problem),
        tables_(tables),
        stop_(stop),
        constraint_table_(problem.graph),
        of_agent_(problem.agents.size()) {}

  // The MDD of the least cost, which is at least `at_least`. There must be a path under the constraints. Sorts and
  // deduplicates them. Null if `stop` was raised.
  std::shared_ptr<const Mdd> get(std::int32_t agent, std::vector<Constraint>& constraints, std::int32_t at_least);

  // Empties the cache if it is too large.
  void trim();

 private:
  struct Entry {
    std::vector<Constraint> constraints;
    std::shared_ptr<const Mdd> mdd;
  };
  using ByHash = std::unordered_multimap<std::uint64_t, Entry>;  // never iterated over

  const Problem& problem_;
  const std::vector<TourTable>& tables_;
  StopSignal* stop_;
  ConstraintTable constraint_table_;
  std::vector<ByHash> of_agent_;
  std::size_t size_ = 0;  // about the number of nodes
};

}  // namespace dmrp::planners
