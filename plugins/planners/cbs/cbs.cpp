// SPDX-License-Identifier: MIT
#include "planners/cbs/cbs.hpp"

namespace dmrp::planners {

Descriptor Cbs::describe() {
  return describe_planner("dmrp.planner.cbs", "CBS", "2.0.0")
      .summary("paths without conflicts, of least sum of costs")
      .source(
          "Sharon, Stern, Felner, Sturtevant: Conflict-based search for optimal multi-agent pathfinding, AIJ 2015; "
          "Li, Harabor, Stuckey, Ma, Gange, Koenig: Pairwise symmetry reasoning for multi-agent path finding search, "
          "AIJ 2021");
}

ConflictSearchOptions Cbs::options() const {
  ConflictSearchOptions options;
  options.suboptimality = 1;
  options.selection = Selection::best_first;
  options.prioritize_conflicts = *prioritize_conflicts;
  options.bypass = *bypass;
  options.target_reasoning = *target_reasoning;
  options.corridor_reasoning = *corridor_reasoning;
  options.rectangle_reasoning = *rectangle_reasoning;
  options.dependency_graph = *weighted_dependency_graph;
  options.disjoint_splitting = *disjoint_splitting;
  return options;
}

}  // namespace dmrp::planners
