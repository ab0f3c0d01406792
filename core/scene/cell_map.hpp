// SPDX-License-Identifier: MIT
// cell_map.hpp: a world that is drawn in square cells, free or blocked: as shapes, and as a grid for points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// What readers of maps take: of cells along a side, and altogether.
inline constexpr std::uint32_t longest_map_side = 10'000;
inline constexpr std::uint64_t most_map_cells = 1 << 24;

// Row-major from the lower left, as dmrp_grid is: index = row * width + column.
struct CellMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> free;  // 1 or 0

  bool is_free(std::uint32_t column, std::uint32_t row) const {
    return free[static_cast<std::size_t>(row) * width + column] != 0;
  }
};

// How many boxes boxes_of() makes.
std::size_t count_boxes(const CellMap& map);

// The blocked cells as few boxes that do not overlap; the lower left cell's corner is at `origin`.
std::vector<Shape> boxes_of(const CellMap& map, double cell_m, dmrp_vec2 origin);

// A map whose lower left corner is at `origin` and whose rows run along origin.theta: its blocked cells as boxes, and
// what the world around it holds beyond its sides, at its corners, as up to four triangles.
struct PlacedBoxes {
  toolkit::Rectangle world;
  std::vector<Shape> shapes;
};
PlacedBoxes place_boxes(const CellMap& map, double cell_m, dmrp_pose origin);

// What build_planning_grid() gives for these boxes, this cell size and a robot of radius and margin 0, origin (0, 0),
// straight from the cells: moves between free neighbours are open, diagonal ones where both cells beside are free too.
PlanningGrid planning_grid_of(const CellMap& map, double cell_m);

}  // namespace dmrp::core
