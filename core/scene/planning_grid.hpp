// SPDX-License-Identifier: MIT
// planning_grid.hpp: the free space as cells: a coarse grid for planners, a finer one for people.
#pragma once

#include <dmrp/grid.h>

#include <cstdint>
#include <vector>

#include "core/scene/static_geometry.hpp"

namespace dmrp::core {

struct PlanningGrid {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  double resolution_m = 1.0;
  dmrp_vec2 origin{};
  std::vector<std::uint8_t> free;
  std::vector<std::uint8_t> edges;
  std::vector<float> clearance;
  std::vector<std::uint8_t> at_open_edge;  // nearest to the edge of a map that is open there; empty for other worlds

  // Valid as long as this struct is neither moved nor changed.
  dmrp_grid view() const;
};

// The cells start at the world's lower left corner. A cell is free if the clearance at its centre is at least
// radius + margin. An edge is open if the disc of `radius_m` swept along the move stays free. The sweep is exact:
// sampling, every 0.05 m say, could miss a corner.
PlanningGrid build_planning_grid(const StaticGeometry& geometry, double resolution_m, double radius_m, double margin_m);

// The grid for the navigation of people of this radius, with the ways that lead beside the centres of its cells
// (narrow_ways.hpp).
inline constexpr double walking_resolution_m = 0.25;
PlanningGrid build_walking_grid(const StaticGeometry& geometry, double radius_m,
                                double resolution_m = walking_resolution_m);

// Marks the cells that are reachable from a cell over orthogonal edges: the moves that every planner can use. Cells that
// are marked in `closed` are not entered; empty: none is closed.
std::vector<bool> reachable_cells(const PlanningGrid& grid, std::uint32_t from, const std::vector<bool>& closed = {});

}  // namespace dmrp::core
