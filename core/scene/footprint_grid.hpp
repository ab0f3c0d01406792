// SPDX-License-Identifier: MIT
// footprint_grid.hpp: the planning grid of a robot of any footprint.
#pragma once

#include "core/scene/planning_grid.hpp"
#include "core/scene/settings.hpp"

namespace dmrp::core {

// For a disc as in planning_grid.hpp. For polygons there are two kinds of free cell:
// - the robot can turn on it: the clearance at its centre is at least the robot's radius + margin
// - it can only pass, along one of the four axes (E-W, NE-SW, N-S, NW-SE): the footprint, heading either way along that
//   axis, keeps `margin_m` from everything. Of several axes, the one that joins the most cells.
// An edge is open if the footprint stays free on the way, heading along it either way. A cell on which the robot cannot
// turn has edges along its axis only. So a transporter passes a corridor that is wider than it and narrower than its
// diagonal, but no plan turns it there.
PlanningGrid build_planning_grid(const StaticGeometry& geometry, double resolution_m, const RobotSettings& robot,
                                 double margin_m);

}  // namespace dmrp::core
