// SPDX-License-Identifier: MIT
#include "planners/eecbs/eecbs.hpp"

namespace dmrp::planners {

Descriptor Eecbs::describe() {
  return describe_planner("dmrp.planner.eecbs", "EECBS", "1.0.0")
      .summary("paths without conflicts, of a sum of costs within a bound of the least; explicit estimation search")
      .source(
          "Li, Ruml, Koenig: EECBS: A bounded-suboptimal search for multi-agent path finding, AAAI 2021; restarts: "
          "Cohen, Koenig, Kumar, Wagner, Choset, Chan, Sturtevant: Rapid randomized restarts for multi-agent path "
          "finding solvers, SoCS 2018");
}

ConflictSearchOptions Eecbs::options() const {
  ConflictSearchOptions options;
  options.suboptimality = *suboptimality;
  options.selection = *explicit_estimation ? Selection::explicit_estimation : Selection::focal;
  options.prioritize_conflicts = *prioritize_conflicts;
  options.bypass = *bypass;
  options.target_reasoning = *target_reasoning;
  options.corridor_reasoning = *corridor_reasoning;
  options.rectangle_reasoning = *rectangle_reasoning;
  options.dependency_graph = *weighted_dependency_graph;
  options.disjoint_splitting = *disjoint_splitting;
  options.conflict_steps = *conflict_steps;
  options.replan_in_place = *replan_in_place;
  options.restart_after = *restart_after;
  options.seed = seed();
  return options;
}

}  // namespace dmrp::planners
