// SPDX-License-Identifier: MIT
// flow_routes.hpp: the routes of a scenario's flows.
#pragma once

#include <dmrp/values.h>

#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// A way between two regions: points about one cell of the walking grid apart.
using Route = std::vector<dmrp_vec2>;

struct FlowRoutes {
  std::vector<std::vector<Route>> legs;  // by flow; leg i leads from its region i to region i + 1
};

// The shortest ways from the centre of each flow's first region through its other regions, or straight lines where no
// free way exists. Takes milliseconds for each region, so trials of the same scenario should share the result.
FlowRoutes find_flow_routes(const Scenario& scenario, const PlanningGrid& walking_grid);

}  // namespace dmrp::core
