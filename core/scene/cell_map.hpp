// SPDX-License-Identifier: MIT
// cell_map.hpp: a map of square cells, free or blocked, and its conversion to shapes and to a grid for point robots.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <dmrp/toolkit/rectangle.hpp>
#include <string_view>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// The largest map that readers accept, in cells.
inline constexpr std::uint32_t max_map_side = 10'000;
inline constexpr std::uint64_t max_map_cells = 1 << 24;

// Row-major from the lower left, like dmrp_grid: index = row * width + column.
struct CellMap {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> free;  // 1 or 0

  bool is_free(std::uint32_t column, std::uint32_t row) const {
    assert(column < width && row < height);
    return free[static_cast<std::size_t>(row) * width + column] != 0;
  }
};

// The number of boxes that boxes_of() returns.
std::size_t count_boxes(const CellMap& map);

// The blocked cells as a small number of boxes that do not overlap. `origin` is the lower left corner of the map.
std::vector<Shape> boxes_of(const CellMap& map, double cell_m, dmrp_vec2 origin);

// The beginning of the names of shapes beyond the map's edge.
inline constexpr std::string_view beyond_map = "outside of the map ";

// A map whose lower left corner is at `origin` and whose rows run along origin.theta: its blocked cells as boxes, and
// up to four triangles that fill the corners of the world, its bounding rectangle, outside the map.
struct PlacedBoxes {
  toolkit::Rectangle world;
  std::vector<Shape> shapes;
};
PlacedBoxes place_boxes(const CellMap& map, double cell_m, dmrp_pose origin);

// The result of build_planning_grid() for these boxes, this cell size and a robot of radius and margin 0, origin (0,
// 0), computed directly from the cells: moves between free neighbours are open, diagonal ones if both cells beside the
// diagonal are free too.
PlanningGrid planning_grid_of(const CellMap& map, double cell_m);

}  // namespace dmrp::core
