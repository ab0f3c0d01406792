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
 protected:
  virtual ConflictSearchOptions options() const = 0;

  Status plan_unequal(const PlanningProblem& host_problem, const std::string& unequal, StopSignal& stop,
                      PlanSink& sink) final;
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) final;
};

}  // namespace dmrp::planners
