// SPDX-License-Identifier: MIT
// individual.hpp: each robot's own shortest path, as if it were alone. The control for whether coordination matters.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

// Shortest in steps, 4-connected; of these one with fewest turns. Robots that rest are ignored like all others.
// NO_SOLUTION if a robot's start or goal is cut off.
class Individual final : public GlobalPlanner {
 public:
  static Descriptor describe();
  Status plan(const PlanningProblem& problem, PlanSink& sink) override;
};

}  // namespace dmrp::planners
