// SPDX-License-Identifier: MIT
// high_level.hpp: conflict-based search (Sharon et al. 2015), optimal and bounded-suboptimal: the engine of CBS, ECBS
// and EECBS.
//
// The high level searches a tree of constraints. It resolves conflicts between the agents' paths by splitting a node
// into two children with different constraints. The low level plans single agents under these constraints.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "planners/conflict_search/high_level/cost_estimate.hpp"
#include "planners/conflict_search/high_level/node_queue.hpp"
#include "planners/conflict_search/high_level/pair_weights.hpp"
#include "planners/conflict_search/high_level/splitting.hpp"

namespace dmrp::planners {

class HighLevel {
 public:
  enum class Result { solved, unsolvable, stopped, limit };

  // `weights` raise the bounds of nodes; null for none. It must outlive the search.
  HighLevel(const SearchContext& context, const ConflictSearchOptions& options, PairWeights* weights = nullptr);

  // Plans for some agents, which have these constraints from the start.
  Result run(const std::vector<std::int32_t>& members, const std::vector<Constraint>& constraints);

  // After Result::solved: the members' paths, by agent.
  const std::vector<AgentPath>& solution() const { return node_.paths(); }
  // After Result::unsolvable: why there is no plan.
  const std::string& obstruction() const { return obstruction_; }
  // No solution costs less.
  std::int32_t lower_bound() const { return queue_.lower_bound(); }
  ConflictSearchStatistics statistics() const;

 private:
  // Of one search.
  struct Limits {
    std::int64_t nodes;
    std::int64_t expansions;
  };

  Result search(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints,
                const Limits& limits);
  bool insert_root(const std::vector<std::int32_t>& order, const std::vector<Constraint>& constraints);
  bool raise_bound();
  void replan_in_place();
  std::vector<std::int32_t> agents_to_replan();
  bool replan(const std::vector<Constraint>& constraints, Child& child);
  bool try_bypass(Child& child);
  void insert(const Child& child);
  NodeId add(const Child& child);

  SearchContext context_;
  ConflictSearchOptions options_;
  PairWeights* weights_;
  ConstraintTree tree_;
  NodeQueue queue_;
  EnteredNode node_;
  Splitter splitter_;
  Replanner replanner_;
  CostEstimate estimate_;
  std::vector<std::int32_t> members_;
  std::int32_t proved_bound_ = 0;       // by the searches before the last restart
  std::int64_t expansions_of_run_ = 0;  // over all restarts
  ConflictSearchStatistics statistics_;
  std::string obstruction_;
  std::array<Child, 2> children_;  // kept for their buffers
};

}  // namespace dmrp::planners
