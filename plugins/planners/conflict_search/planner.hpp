// SPDX-License-Identifier: MIT
// planner.hpp: the common part of CBS, ECBS and EECBS as plugins: reads the host's problem, searches, hands over paths.
#pragma once

#include <dmrp/plugin.hpp>

#include "planners/conflict_search/high_level/options.hpp"

namespace dmrp::planners {

// Returns NO_SOLUTION for problems that provably have no plan: a start or goal is cut off; two robots end on one cell,
// or would have to pass each other in a corridor without a branch; or all joint positions of few robots in a small part
// of the map were tried. On other problems without a plan the search does not end by itself: it returns TIMEOUT after
// `node_limit` nodes or when the host asks it to stop.
class ConflictSearchPlanner : public GlobalPlanner {
 public:
  Status plan(const PlanningProblem& problem, PlanSink& sink) final;

 protected:
  virtual ConflictSearchOptions options() const = 0;
};

}  // namespace dmrp::planners
