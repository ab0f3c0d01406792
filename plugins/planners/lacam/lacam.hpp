// SPDX-License-Identifier: MIT
// lacam.hpp: complete and fast for thousands of robots: a lazy search over the configurations of all robots.
#pragma once

#include "planners/mapf/graph_planner.hpp"

namespace dmrp::planners {

// LaCAM* (Okumura 2023) with PIBT as the generator of configurations and its swap. Finds a first plan where prioritized
// planning jams, then improves it for `iterations` and, run to the end, returns a plan with the least sum of costs.
//
// `lower_bound` is the sum of the robots' costs alone; once all configurations were visited, `cost`. Returns
// NO_SOLUTION if all were visited without a plan, TIMEOUT if the host asks it to stop, or its configurations take 2 GB,
// before the first plan. After the first plan it always returns a plan.
class Lacam final : public GraphPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> iterations = param("iterations", 1000)
                                       .unit("1")
                                       .range(0, 1'000'000'000)
                                       .doc(
                                           "configurations generated after the first plan, to improve it; 0: until the "
                                           "time budget ends, which is not repeatable");

 protected:
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) override;
};

}  // namespace dmrp::planners
