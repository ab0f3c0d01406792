// SPDX-License-Identifier: MIT
// individual.hpp: each robot's own shortest path, regardless of the others: the control for the effect of coordination.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

// The shortest path in steps, 4-connected; of these one with the fewest turns. Ignores all other robots, resting ones
// included. Returns NO_SOLUTION if a robot's start or goal is cut off.
class Individual final : public GlobalPlanner {
 public:
  static Descriptor describe();
  Status plan(const PlanningProblem& problem, PlanSink& sink) override;
};

}  // namespace dmrp::planners
