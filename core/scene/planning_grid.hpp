// SPDX-License-Identifier: MIT
// planning_grid.hpp: free space as cells: coarse ones for planners, finer ones for people.
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

  // Valid as long as this struct stays where it is.
  dmrp_grid view() const;
};

// Cells from the world's lower left corner. A cell is free when the clearance at its centre is at least
// radius + margin; an edge stands when the disc of `radius_m` swept along the move stays free: decided exactly, where
// sampling every 0.05 m could step over a corner.
PlanningGrid build_planning_grid(const StaticGeometry& geometry, double resolution_m, double radius_m, double margin_m);

// The grid on which people of this radius find their way.
inline constexpr double walking_resolution_m = 0.25;
PlanningGrid build_walking_grid(const StaticGeometry& geometry, double radius_m);

}  // namespace dmrp::core
