// SPDX-License-Identifier: MIT
// planner.hpp: what the planners by conflict-based search have in common: from the host's problem to its sink.
#pragma once

#include <dmrp/plugin.hpp>

#include "planners/conflict_search/high_level/search.hpp"

namespace dmrp::planners {

// NO_SOLUTION: a start or goal is cut off; two robots end on one cell, or would have to pass each other in a corridor
// without a branch; the joint positions of few robots in a small part of the map were all tried. The search itself does
// not end on other problems without a plan: TIMEOUT after `node_limit` nodes or when the host says so.
class ConflictSearchPlanner : public GlobalPlanner {
 public:
  Status plan(const PlanningProblem& problem, PlanSink& sink) final;

 protected:
  virtual ConflictSearchOptions options() const = 0;
};

}  // namespace dmrp::planners
