// SPDX-License-Identifier: MIT
// pibt.hpp: priority inheritance with backtracking, step by step until all robots rest.
#pragma once

#include "planners/mapf/graph_planner.hpp"

namespace dmrp::planners {

// PIBT (Okumura, Machida, Defago, Tamura 2022) with the swap of Okumura 2023: the fastest planner here, for any number
// of robots, and the baseline of the field. Each step follows from the one before; nothing is ever taken back. So the
// sum of costs is far from the least, and the robots may never all be at their goals at once: after `step_limit` steps
// it returns TIMEOUT. Asked for a window, it stops after as many steps. Asked again, a robot that makes no progress keeps
// the priority of the steps that it has waited. `lower_bound` is the sum of the robots' costs
// alone.
class Pibt final : public GraphPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> step_limit = param("step_limit", 10'000)
                                       .unit("1")
                                       .range(1, 10'000'000)
                                       .doc("steps of the plan after which the planner gives up");

 protected:
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) override;
};

}  // namespace dmrp::planners
