// SPDX-License-Identifier: MIT
// mdd.hpp: all of an agent's paths of least cost under its constraints, as the places it can be at each time
// (a multi-valued decision diagram; Sharon et al. 2013), and a cache of them.
#pragma once

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

  // Empty if there is no path of this cost, or if `stop` says so. `cost` is at most the least under the constraints.
  Mdd(const GridGraph& graph, const Agent& agent, const TourTable& table, const ConstraintTable& constraints,
      std::int32_t cost, StopSignal* stop = nullptr);

  // Whether the agent can be at its goal one step before and wait there, but must not have come to rest so early. (So a
  // longer path can meet the last node by a way that is not in here: no other node can be met like that.)
  bool may_wait_at_end() const { return may_wait_at_end_; }

  bool is_empty() const { return nodes_.empty(); }
  std::size_t node_count() const { return nodes_.size(); }
  std::int32_t cost() const { return static_cast<std::int32_t>(level_begin_.size()) - 2; }

  // The nodes of a time up to cost(), each on at least one path.
  std::span<const Node> level(std::int32_t t) const {
    const auto at = static_cast<std::size_t>(t);
    return {nodes_.data() + level_begin_[at], nodes_.data() + level_begin_[at + 1]};
  }

  // Whether every path of this cost is at `location` at time t (or rests there by then).
  bool must_be_at(Location location, std::int32_t t) const;

 private:
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> level_begin_;
  bool may_wait_at_end_ = false;
};

// The MDDs made so far, keyed by what they follow from: the agent and its constraints.
class MddCache {
 public:
  MddCache(const Problem& problem, const std::vector<TourTable>& tables, StopSignal* stop = nullptr)
      : problem_(problem),
        tables_(tables),
        stop_(stop),
        constraint_table_(problem.graph),
        of_agent_(problem.agents.size()) {}

  // `constraints` are the agent's in any order, and there is a path under them; none costs less than `at_least`. Sorts
  // the constraints. Null if `stop` says so.
  std::shared_ptr<const Mdd> get(std::int32_t agent, std::vector<Constraint>& constraints, std::int32_t at_least);

  // Forgets everything once it has grown too large.
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
  std::size_t size_ = 0;  // nodes of all
};

}  // namespace dmrp::planners
