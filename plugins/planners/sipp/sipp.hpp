// SPDX-License-Identifier: MIT
// sipp.hpp: prioritized safe-interval path planning: plans robots one after the other and treats the earlier ones as
// moving obstacles.
#pragma once

#include "planners/mapf/graph_planner.hpp"

namespace dmrp::planners {

// Phillips, Likhachev 2011, with additions that make prioritized planning succeed more often. The robots with the
// nearest goals come first. A robot without a free path displaces the robots that block it (found as in SIPPS, Li et
// al. 2022); these are planned again after all others, and their price grows. When that does not converge, the search
// restarts with a random order and random delays, drawn from the seed. Finally turns are removed where the other paths
// allow.
//
// Plans have no vertex or swap conflicts: moving, waiting and resting robots are obstacles. Each path has the least
// cost among the paths that were planned before it and kept; the sum of costs has no bound. `lower_bound` is the sum of
// the robots' costs alone.
//
// Returns NO_SOLUTION for problems that provably have no plan: a start or goal is cut off; two robots end on one cell,
// or would have to pass each other in a corridor without a branch; or all joint positions of few robots in a small part
// of the map were tried. Returns TIMEOUT after `restarts` or when the host asks it to stop. Prioritized planning is not
// complete: where two robots have to give way to each other, one must be late, and only a delay at its start makes it
// so.
class Sipp final : public GraphPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> restarts =
      param("restarts", 1000).unit("1").range(0, 100'000'000).doc("restarts in a new order before the search gives up");

 protected:
  Status plan_unequal(const PlanningProblem& host_problem, const std::string& unequal, StopSignal& stop,
                      PlanSink& sink) override;
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) override;
};

}  // namespace dmrp::planners
