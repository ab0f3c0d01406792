// SPDX-License-Identifier: MIT
// ecbs8.hpp: enhanced conflict-based search on the 8-connected grid: paths without conflicts, of bounded cost.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

// ECBS(w), Barer et al. 2014, with straight and diagonal moves; the paper's Algorithm 1.
//
// Time: a straight move, a diagonal and a wait each take one step of the plan, so robots drive diagonals sqrt(2) times
// as fast. Cost is not time: a straight move costs 1, a diagonal sqrt(2), a wait 1 until the robot rests at its last
// goal, then 0.
//
// Conflicts: two robots in one cell; two that swap; two diagonals that cross; a diagonal from t to t+1 beside a robot
// that is on either of the cells between its ends at t or at t+1. No diagonal cuts a corner.
//
// The cost is at most `suboptimality` times the reported lower bound. Of a robot's paths within its limit the search
// prefers one with few conflicts, then one of low cost, then one with few turns.
//
// Returns NO_SOLUTION for problems that provably have no plan: a start or goal is cut off; two robots end on one cell,
// or would have to pass each other in a corridor without a branch; or all joint positions of few robots in a small part
// of the map were tried. On other problems without a plan ECBS does not end by itself: it returns TIMEOUT after
// `node_limit` nodes or when the host asks it to stop.
class Ecbs8 final : public GlobalPlanner {
 public:
  static Descriptor describe();

  Param<double> suboptimality = param("suboptimality", 2.0)
                                    .unit("1")
                                    .range(1.0, 100.0)
                                    .doc("the cost is at most this factor times the lower bound");
  Param<std::int64_t> node_limit = param("node_limit", 500000)
                                       .unit("1")
                                       .range(1, 100'000'000)
                                       .doc("constraint-tree nodes after which the search gives up");

  Status plan(const PlanningProblem& problem, PlanSink& sink) override;
};

}  // namespace dmrp::planners
