// SPDX-License-Identifier: MIT
// sipp.hpp: prioritized safe-interval path planning: robots one after the other, among those before as moving
// obstacles.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

// Phillips, Likhachev 2011, with what is known to make prioritized planning succeed: first the robots with the nearest
// goals; a robot that finds no way displaces those that stand in it (found as in SIPPS, Li et al. 2022), and these are
// planned again after all others, at a price that grows; new orders, and delays, drawn at random by the seed when that
// goes round in circles. In the end turns are taken out as far as the others' paths allow.
//
// There are no vertex or swap conflicts: robots are seen when they move, wait and rest. A path costs least among those
// that were planned before it and kept; the sum of costs has no bound. `lower_bound` is the sum of what the robots
// would cost alone.
//
// NO_SOLUTION: a start or goal is cut off; two robots end on one cell, or would have to pass each other in a corridor
// without a branch; the joint positions of few robots in a small part of the map were all tried. TIMEOUT after
// `restarts` or when the host says so. Prioritized planning is not complete: of two robots that have to yield to each
// other one must be late for that, which only a delay at its start can bring about here.
class Sipp final : public GlobalPlanner {
 public:
  static Descriptor describe();

  Param<std::int64_t> restarts = param("restarts", 1000)
                                     .unit("1")
                                     .range(0, 100'000'000)
                                     .doc("new orders that are drawn before the search gives up");

  Status start(const World& world, std::uint64_t seed) override;
  Status plan(const PlanningProblem& problem, PlanSink& sink) override;

 private:
  std::uint64_t seed_ = 0;
};

}  // namespace dmrp::planners
