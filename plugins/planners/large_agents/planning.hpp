// SPDX-License-Identifier: MIT
// planning.hpp: what CBS, ECBS, EECBS and SIPP do with robots that differ or can touch on different cells.
#pragma once

#include <dmrp/plugin.hpp>

#include "planners/large_agents/fleet.hpp"

namespace dmrp::planners {

// The result of a planner, and its text for the host where there is no plan.
struct FleetAnswer {
  Status status = Status::ok;
  std::string error;
};

FleetAnswer plan_by_conflict_search(const PlanningProblem& problem, double suboptimality, std::int64_t node_limit,
                                    StopSignal& stop, PlanSink& sink);

FleetAnswer plan_by_priorities(const PlanningProblem& problem, std::int64_t restart_limit, std::uint64_t seed,
                               StopSignal& stop, PlanSink& sink);

}  // namespace dmrp::planners
