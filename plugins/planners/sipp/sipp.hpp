// SPDX-License-Identifier: MIT
// sipp.hpp: prioritized safe-interval path planning: robots one after the other, among those before as moving
// obstacles.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::planners {

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
