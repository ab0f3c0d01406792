// SPDX-License-Identifier: MIT
// cbs.hpp: conflict-based search: paths without conflicts, of least sum of costs.
#pragma once

#include "planners/conflict_search/planner.hpp"

namespace dmrp::planners {

// Sharon et al. 2015, with the improvements of CBSH2-RTC (Li et al. 2021): prioritized conflicts and bypass (Boyarski
// et al. 2015), the weighted dependency graph heuristic (Li et al. 2019), and rectangle, corridor and target reasoning
// (Li et al. 2019, 2020). Each has a parameter that disables it. Disjoint splitting (Li et al. 2019) is optional.
//
// The sum of costs is optimal. The cost of a robot is its number of steps until it rests at its last goal. Plans have
// no vertex or swap conflicts; robots rest at their goals, and inactive robots where they are. Of paths with equal cost
// and conflicts the search prefers those with fewer turns. The reported `lower_bound` equals the cost.
class Cbs final : public ConflictSearchPlanner {
 public:
  static Descriptor describe();

  Param<bool> prioritize_conflicts =
      param("prioritize_conflicts", true).doc("split first on conflicts that raise the cost of both children");
  Param<bool> bypass =
      param("bypass", true).doc("adopt a path with fewer conflicts at the same cost instead of a split");
  Param<bool> weighted_dependency_graph =
      param("weighted_dependency_graph", true)
          .doc("raise the lower bound of a node by the dependencies between pairs of robots");
  Param<bool> rectangle_reasoning =
      param("rectangle_reasoning", true).doc("resolve crossings on open ground by one split");
  Param<bool> corridor_reasoning = param("corridor_reasoning", true).doc("resolve meetings in a corridor by one split");
  Param<bool> target_reasoning =
      param("target_reasoning", true).doc("resolve conflicts at a goal that a robot has reached by one split");
  Param<bool> disjoint_splitting =
      param("disjoint_splitting", false).doc("one child requires a robot to pass a place, the other forbids it");

 protected:
  ConflictSearchOptions options() const override;
};

}  // namespace dmrp::planners
