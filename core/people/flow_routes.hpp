// SPDX-License-Identifier: MIT
// flow_routes.hpp: the ways along which the flows of a scenario walk.
#pragma once

#include <dmrp/values.h>

#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// One way between regions: points about a walking cell apart.
using Route = std::vector<dmrp_vec2>;

struct FlowRoutes {
  std::vector<std::vector<Route>> legs;  // by flow, then from its region i to region i + 1
};

// Shortest ways from the middle of each flow's first region on; straight ones where none is free. Takes milliseconds a
// region, so share the result between the trials of a scenario.
FlowRoutes find_flow_routes(const Scenario& scenario, const PlanningGrid& walking_grid);

}  // namespace dmrp::core
