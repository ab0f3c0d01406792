// SPDX-License-Identifier: MIT
// lns.hpp: a quick plan that gets cheaper with every iteration, for any number of robots.
#pragma once

#include "planners/mapf/graph_planner.hpp"

namespace dmrp::planners {

// MAPF-LNS (Li et al. 2021). Begins with prioritized planning as in dmrp.planner.sipp or, where that displaces many
// robots, with the first plan of dmrp.planner.lacam, which is complete. Then improves the plan by large neighborhood
// search. Every plan on the way is complete and has no conflicts, so it returns the best one whenever the host asks it
// to stop.
//
// `lower_bound` is the sum of the robots' costs alone; the sum of costs has no bound. Returns NO_SOLUTION if that is
// proved, TIMEOUT if the host asks it to stop before the first plan.
class Lns final : public GraphPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> iterations = param("iterations", 1000)
                                       .unit("1")
                                       .range(0, 1'000'000'000)
                                       .doc(
                                           "neighborhoods planned again; 0: until the time budget ends, which is not "
                                           "repeatable");

 protected:
  Status solve(const PlanningProblem& host_problem, const Preparation& prepared, StopSignal& stop,
               PlanSink& sink) override;
};

}  // namespace dmrp::planners
