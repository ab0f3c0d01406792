// SPDX-License-Identifier: MIT
// node_queue.hpp: the open nodes of the constraint tree, and which of them to expand next.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "planners/conflict_search/high_level/constraint_tree.hpp"
#include "planners/conflict_search/high_level/options.hpp"

namespace dmrp::planners {

// Three lists of the open nodes: CLEANUP by f, which gives the lower bound; OPEN by (estimated) cost; FOCAL, the nodes
// of OPEN within the bound, by conflicts. FOCAL follows OPEN as the bound moves and is never rebuilt.
class NodeQueue {
 public:
  struct Choice {
    NodeId node = no_node;
    bool for_its_bound = false;  // selected to raise the lower bound rather than to find a solution

    explicit operator bool() const { return node != no_node; }
  };

  NodeQueue(ConstraintTree& tree, Selection selection, double suboptimality)
      : tree_(tree), selection_(selection), suboptimality_(suboptimality) {}

  // Empties the queue. No solution costs less than `lower_bound`.
  void reset(std::int32_t lower_bound);
  void insert(NodeId id);
  // Removes the best node; false if none is left.
  Choice select();

  // No solution costs less: the greatest least f of all open nodes so far.
  std::int32_t lower_bound() const { return lower_bound_; }
  // Raises the lower bound to the least f of the open nodes. False if there is none.
  bool raise_bound();

 private:
  struct ByBound {
    std::int32_t f;
    std::int32_t pairs;
    NodeId node;
  };
  struct ByConflicts {
    std::int32_t pairs;
    double cost;
    NodeId node;
  };
  struct State {
    bool is_open = false;
    bool is_in_focal = false;
  };

  static bool is_later(const ByBound& a, const ByBound& b);
  static bool is_later_in_focal(const ByConflicts& a, const ByConflicts& b);
  bool is_within_bound(NodeId id) const { return tree_.node(id).cost <= suboptimality_ * lower_bound_ + 1e-9; }
  double rank(NodeId id) const;
  void move_focal_limit();
  void push_focal(NodeId id);
  NodeId first_in_focal();
  NodeId remove(NodeId id);
  State& state(NodeId id) { return states_[static_cast<std::size_t>(id)]; }

  ConstraintTree& tree_;
  Selection selection_;
  double suboptimality_;
  std::int32_t lower_bound_ = 0;
  double focal_limit_ = -1;
  std::vector<ByBound> cleanup_;              // a heap; skips stale entries
  std::set<std::pair<double, NodeId>> open_;  // by rank
  std::vector<ByConflicts> focal_;            // a heap; skips stale entries
  std::vector<State> states_;                 // by node
};

}  // namespace dmrp::planners
