// SPDX-License-Identifier: MIT
// node_queue.hpp: which node of the constraint tree comes next.
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "planners/conflict_search/high_level/constraint_tree.hpp"

namespace dmrp::planners {

enum class Selection {
  best_first,           // least f (A*)
  focal,                // fewest conflicts among the nodes whose cost is within the bound (Barer et al. 2014)
  explicit_estimation,  // likewise among those whose estimated cost is (Thayer, Ruml 2011; Li, Ruml, Koenig 2021)
};

// CLEANUP orders the open nodes by f and gives the lower bound, OPEN by (estimated) cost, FOCAL by conflicts. FOCAL
// holds the nodes of OPEN within the bound and follows it as it moves, without being built anew.
class NodeQueue {
 public:
  NodeQueue(ConstraintTree& tree, Selection selection, double suboptimality)
      : tree_(tree), selection_(selection), suboptimality_(suboptimality) {}

  // Empties it. No solution costs less than `lower_bound`.
  void reset(std::int32_t lower_bound);
  void push(NodeId id);

  struct Choice {
    NodeId node = no_node;
    bool for_its_bound = false;  // taken to raise the lower bound rather than to find a solution
  };
  // Takes a node out; no_node if none is left.
  Choice pop();

  // The least f there has been of all open nodes when one was taken: no solution costs less.
  std::int32_t lower_bound() const { return lower_bound_; }
  // Looks at the open nodes as they are now. False if there is none.
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
  NodeId take(NodeId id);
  State& state(NodeId id) { return states_[static_cast<std::size_t>(id)]; }

  ConstraintTree& tree_;
  Selection selection_;
  double suboptimality_;
  std::int32_t lower_bound_ = 0;
  double focal_limit_ = -1;
  std::vector<ByBound> cleanup_;              // a heap; stale entries are skipped
  std::set<std::pair<double, NodeId>> open_;  // by rank
  std::vector<ByConflicts> focal_;            // a heap; stale entries are skipped
  std::vector<State> states_;                 // by node
};

}  // namespace dmrp::planners
