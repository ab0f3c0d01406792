// SPDX-License-Identifier: MIT
// narrow_ways.hpp: ways of a grid that are wide enough for a disc but lead beside the centres of cells.
#pragma once

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

// Opens the doors that the grid's cells miss: whether a disc gets through a gap then depends on the gap alone, not on
// where the cells lie. Cells whose centres are too near to a wall become free, and edges E, N, W, S lead through them, as
// far as a disc of `radius_m`, at least half a cell, can move from each side of a cell to the next; no other edge, and
// nothing that does not join parts of the grid between which there was no way. Gaps are measured to a tenth of a millimetre.
void open_narrow_ways(const StaticGeometry& geometry, double radius_m, PlanningGrid& grid);

}  // namespace dmrp::core
