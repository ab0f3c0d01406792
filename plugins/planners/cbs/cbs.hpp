// SPDX-License-Identifier: MIT
// cbs.hpp: conflict-based search: paths without conflicts, of least sum of costs.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

// Sharon et al. 2015, with prioritized conflicts (Boyarski et al. 2015) and bypass.
//
// The sum of costs is optimal: a robot's steps until it stays at its last goal for good; vertex and swap conflicts
// count, and robots rest at their goals and where they are not active. Of a robot's paths of equal length under the
// same constraints one with fewest conflicts with the others is taken, and of these one with fewest turns; of nodes of
// equal cost and conflicts the one with fewer turns is expanded first. That is not the least number of turns among all
// optimal plans.
//
// NO_SOLUTION: a start or goal is cut off; two robots end on one cell, or would have to pass each other in a corridor
// without a branch; the joint positions of few robots in a small part of the map were all tried. CBS itself does not end
// on other problems without a plan: TIMEOUT after `node_limit` nodes or when the host says so.
class Cbs final : public GlobalPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> node_limit = param("node_limit", 500000)
                                       .unit("1")
                                       .range(1, 100'000'000)
                                       .doc("constraint-tree nodes after which the search gives up");

  Status plan(const PlanningProblem& problem, PlanSink& sink) override;
};

}  // namespace dmrp::planners
