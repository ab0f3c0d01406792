// SPDX-License-Identifier: MIT
// planner.hpp: the common part of CBS, ECBS and EECBS as plugins: reads the host's problem, searches, hands over paths.
#pragma once

#include "planners/conflict_search/high_level/options.hpp"
#include "planners/mapf/graph_planner.hpp"

namespace dmrp::planners {

// Returns NO_SOLUTION for problems that provably have no plan: a start or goal is cut off; two robots end on one cell,
// or would have to pass each other in a corridor without a branch; or all joint positions of few robots in a small part
// of the map were tried. On other problems without a plan the search does not end by itself: it returns TIMEOUT after
// `node_limit` nodes or when the host asks it to stop.
class ConflictSearchPlanner : public GraphPlanner {
 public:
  Param<bool> safe_intervals =
      param("safe_intervals", true).doc("plan single robots over safe intervals; otherwise over single steps");
  Param<std::int64_t> node_limit = param("node_limit", 10'000'000)
                                       .unit("1")
                                       .range(1, 1'000'000'000)
                                       .doc("constraint-tree nodes after which the search gives up");

 protected:
  // Without what all share, the parameters above.
  virtual ConflictSearchOptions options() const = 0;

  Status plan_unequal(const PlanningProblem& host_problem, const std::string& unequal, StopSignal& stop,
                      PlanSink& sink) final;
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) final;
};

}  // namespace dmrp::planners
