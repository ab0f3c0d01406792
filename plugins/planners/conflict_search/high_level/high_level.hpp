// SPDX-License-Identifier: MIT
// high_level.hpp: conflict-based search (Sharon et al. 2015), optimal and bounded-suboptimal: the engine of CBS, ECBS
// and EECBS.
//
// The high level searches a tree of constraints. It resolves conflicts between the agents' paths by splitting a node
// into two children with different constraints. The low level plans single agents under these constraints.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "planners/conflict_search/high_level/node_queue.hpp"
#include "planners/conflict_search/high_level/pair_weights.hpp"
#include "planners/conflict_search/high_level/replanning.hpp"
#include "planners/conflict_search/high_level/splitting.hpp"

namespace dmrp::planners {

// The likely cost of the best solution below a node, learned from one-step errors (Thayer, Dionne, Ruml 2011; for CBS:
// Li, Ruml, Koenig 2021). Not a bound.
class CostEstimate {
 public:
  // The node's cost, plus the mean cost of resolving a conflicting pair for each pair that is left.
  double of(const Node& node) const {
    double estimated = node.cost;
    if (count_ > 0) {
      const double cost_error = std::max(0.0, cost_error_sum_ / static_cast<double>(count_));
      const double distance_error = std::clamp(distance_error_sum_ / static_cast<double>(count_), 0.0, 0.95);
      estimated += node.pairs * cost_error / (1 - distance_error);
    }
    return std::max(estimated, static_cast<double>(node.f));
  }

  // Learns from the step between a node and the best of its children.
  void learn(const Node& parent, std::span<const Child> children) {
    if (children.empty()) return;
    const Node& best =
        std::min_element(children.begin(), children.end(), [](const Child& a, const Child& b) {
          return std::tie(a.node.estimated_cost, a.node.pairs) < std::tie(b.node.estimated_cost, b.node.pairs);
        })->node;
    cost_error_sum_ += best.cost - parent.cost;
    distance_error_sum_ += best.pairs - (parent.pairs - 1);
    ++count_;
  }

 private:
  double cost_error_sum_ = 0;      // how much steps raised the cost
  double distance_error_sum_ = 0;  // how many pairs fewer than one steps resolved
  std::int64_t count_ = 0;
};

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
