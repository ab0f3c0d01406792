// SPDX-License-Identifier: MIT
// eecbs.hpp: explicit estimation conflict-based search: paths without conflicts whose sum of costs is within a factor
// of the least. Estimates the cost of the remaining conflicts.
#pragma once

#include "planners/conflict_search/planner.hpp"

namespace dmrp::planners {

// EECBS(w) of Li, Ruml, Koenig 2021: focal search on the low level, explicit estimation search on the high level, with
// prioritized conflicts, bypass, the weighted dependency graph heuristic, and rectangle, corridor and target reasoning.
// Each has a parameter. Beyond the paper: before a split, robots with conflicts are replanned without new constraints
// (`replan_in_place`); long searches restart with the robots in another order and keep the proved lower bound
// (`restart_after`; rapid randomized restarts, Cohen et al. 2018). In every second restart the low level weighs conflicts
// against steps (`conflict_steps`), in the others it has the paper's order, conflicts first.
//
// Reports `cost` and `lower_bound`: cost <= suboptimality * lower_bound, and no plan costs less than `lower_bound`.
class Eecbs final : public ConflictSearchPlanner {
 public:
  static Descriptor describe();

  Param<double> suboptimality =
      param("suboptimality", 1.2).unit("1").range(1.0, 100.0).doc("the cost is at most this factor times the least");
  Param<bool> explicit_estimation =
      param("explicit_estimation", true)
          .doc("select nodes by their estimated cost; otherwise by their cost, as in ECBS");
  Param<bool> prioritize_conflicts =
      param("prioritize_conflicts", true).doc("split first on conflicts that raise the cost of both children");
  Param<bool> bypass =
      param("bypass", true).doc("adopt a path with fewer conflicts within the bound instead of a split");
  Param<bool> weighted_dependency_graph =
      param("weighted_dependency_graph", true)
          .doc("raise the lower bound of nodes selected for it by the dependencies between pairs of robots");
  Param<bool> rectangle_reasoning =
      param("rectangle_reasoning", true).doc("resolve crossings on open ground by one split");
  Param<bool> corridor_reasoning = param("corridor_reasoning", true).doc("resolve meetings in a corridor by one split");
  Param<bool> target_reasoning =
      param("target_reasoning", true).doc("resolve conflicts at a goal that a robot has reached by one split");
  Param<bool> disjoint_splitting =
      param("disjoint_splitting", false).doc("one child requires a robot to pass a place, the other forbids it");
  Param<bool> replan_in_place =
      param("replan_in_place", true)
          .doc("before a split, replan robots with conflicts as long as that leaves fewer conflicts");
  Param<int> conflict_steps =
      param("conflict_steps", 1)
          .unit("1")
          .range(0, 1000)
          .doc("in every second restart: steps that a path may be longer to avoid a conflict; 0: any within the bound");
  Param<std::int64_t> restart_after =
      param("restart_after", 600)
          .unit("1")
          .range(0, 1'000'000'000)
          .doc(
              "expansions after which the search restarts with the robots in another order; a quarter the first time, "
              "half as many more each time; 0: never");

 protected:
  ConflictSearchOptions options() const override;
};

}  // namespace dmrp::planners
