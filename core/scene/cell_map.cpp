// SPDX-License-Identifier: MIT
#include "core/scene/cell_map.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <string>

namespace dmrp::core {
namespace {

// Blocked cells from first to last column and row, both included.
struct Block {
  std::uint32_t first_column;
  std::uint32_t first_row;
  std::uint32_t last_column;
  std::uint32_t last_row;
};

// Runs of blocked cells in a row, each merged with the run below if that has the same ends.
template <class Blocked>
std::vector<Block> joined_runs(std::uint32_t width, std::uint32_t height, const Blocked& blocked) {
  std::vector<Block> blocks;
  std::vector<std::size_t> open;  // indices of blocks that end in the row before, by column
  for (std::uint32_t row = 0; row < height; ++row) {
    std::vector<std::size_t> still_open;
    auto below = open.begin();
    for (std::uint32_t column = 0; column < width; ++column) {
      if (!blocked(column, row)) continue;
      const std::uint32_t first = column;
      while (column + 1 < width && blocked(column + 1, row)) ++column;
      while (below != open.end() && blocks[*below].first_column < first) ++below;
      if (below != open.end() && blocks[*below].first_column == first && blocks[*below].last_column == column) {
        blocks[*below].last_row = row;
        still_open.push_back(*below);
      } else {
        still_open.push_back(blocks.size());
        blocks.push_back({first, row, column, row});
      }
    }
    open = std::move(still_open);
  }
  return blocks;
}

// Walls along the rows give fewer blocks by rows, walls along the columns by columns. Returns the smaller result.
std::vector<Block> blocks_of(const CellMap& map) {
  const auto by_rows = joined_runs(map.width, map.height,
                                   [&](std::uint32_t column, std::uint32_t row) { return !map.is_free(column, row); });
  auto by_columns = joined_runs(map.height, map.width,
                                [&](std::uint32_t row, std::uint32_t column) { return !map.is_free(column, row); });
  if (by_rows.size() <= by_columns.size()) return by_rows;
  for (Block& block : by_columns) {
    std::swap(block.first_column, block.first_row);
    std::swap(block.last_column, block.last_row);
  }
  return by_columns;
}

// Along one axis, from a cell's centre to the nearest point of a cell `offset` cells away, squared, in cells.
double squared_gap(std::uint32_t offset) {
  const double gap = offset == 0 ? 0.0 : static_cast<double>(offset) - 0.5;
  return gap * gap;
}

// The number of cells from each cell to the nearest blocked cell of its column, where cells beyond the border count as
// blocked; 0 for a blocked cell.
std::vector<std::uint32_t> steps_to_blocked_in_column(const CellMap& map) {
  std::vector<std::uint32_t> steps(map.free.size());
  for (std::uint32_t column = 0; column < map.width; ++column) {
    std::uint32_t since = 0;
    for (std::uint32_t row = 0; row < map.height; ++row) {
      since = map.is_free(column, row) ? since + 1 : 0;
      steps[static_cast<std::size_t>(row) * map.width + column] = since;
    }
    since = 0;
    for (std::uint32_t row = map.height; row-- > 0;) {
      since = map.is_free(column, row) ? since + 1 : 0;
      std::uint32_t& least = steps[static_cast<std::size_t>(row) * map.width + column];
      least = std::min(least, since);
    }
  }
  return steps;
}

// The distance from every free cell's centre to the nearest blocked cell or the border; 0 for blocked cells.
void find_clearances(const CellMap& map, PlanningGrid& grid) {
  const std::vector<std::uint32_t> steps = steps_to_blocked_in_column(map);
  for (std::uint32_t row = 0; row < map.height; ++row) {
    const std::uint32_t* const of_row = steps.data() + static_cast<std::size_t>(row) * map.width;
    for (std::uint32_t column = 0; column < map.width; ++column) {
      if (of_row[column] == 0) continue;
      // The columns beyond the border are blocked.
      const std::uint32_t to_border = std::min(column + 1, map.width - column);
      double least = std::min(squared_gap(of_row[column]), squared_gap(to_border));
      for (std::uint32_t offset = 1; offset < to_border && squared_gap(offset) < least; ++offset)
        least = std::min({least, squared_gap(offset) + squared_gap(of_row[column - offset]),
                          squared_gap(offset) + squared_gap(of_row[column + offset])});
      grid.clearance[static_cast<std::size_t>(row) * map.width + column] =
          static_cast<float>(std::sqrt(least) * grid.resolution_m);
    }
  }
}

// Corners of the world that are not thicker than this get no triangle.
constexpr double thinnest_corner_m = 1e-6;

// Adds the triangle between each side of the rotated map and the corner of the world. `corners`: of the map,
// counter-clockwise.
void append_corners(const std::array<dmrp_vec2, 4>& corners, PlacedBoxes& out) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dmrp_vec2 from = corners[i];
    const dmrp_vec2 to = corners[(i + 1) % corners.size()];
    const dmrp_vec2 side = to - from;
    if (std::abs(side.x) < thinnest_corner_m || std::abs(side.y) < thinnest_corner_m) continue;
    // The outside is on the right of a side.
    const dmrp_vec2 beyond = {side.y > 0.0 ? out.world.upper.x : out.world.lower.x,
                              side.x > 0.0 ? out.world.lower.y : out.world.upper.y};
    Shape shape;
    shape.name = std::string(beyond_map) + std::to_string(i + 1);
    shape.vertices = {to, from, beyond};
    out.shapes.push_back(std::move(shape));
  }
}

}  // namespace

std::size_t count_boxes(const CellMap& map) {
  assert(map.free.size() == std::size_t{map.width} * map.height);
  return blocks_of(map).size();
}

std::vector<Shape> boxes_of(const CellMap& map, double cell_m, dmrp_vec2 origin) {
  assert(map.free.size() == std::size_t{map.width} * map.height && cell_m > 0.0);
  std::vector<Shape> shapes;
  for (const Block& block : blocks_of(map)) {
    const dmrp_vec2 lower = {origin.x + cell_m * block.first_column, origin.y + cell_m * block.first_row};
    const dmrp_vec2 upper = {origin.x + cell_m * (block.last_column + 1.0), origin.y + cell_m * (block.last_row + 1.0)};
    Shape shape;
    shape.name = "cells " + std::to_string(shapes.size() + 1);
    shape.vertices = {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}};
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

PlacedBoxes place_boxes(const CellMap& map, double cell_m, dmrp_pose origin) {
  const dmrp_vec2 corner = {origin.x, origin.y};
  const dmrp_vec2 size = {cell_m * map.width, cell_m * map.height};
  if (origin.theta == 0.0) return {{corner, corner + size}, boxes_of(map, cell_m, corner)};

  const double c = std::cos(origin.theta);
  const double s = std::sin(origin.theta);
  const auto placed = [&](dmrp_vec2 p) { return corner + dmrp_vec2{c * p.x - s * p.y, s * p.x + c * p.y}; };
  PlacedBoxes out;
  out.shapes = boxes_of(map, cell_m, {0.0, 0.0});
  for (Shape& shape : out.shapes)
    for (dmrp_vec2& vertex : shape.vertices) vertex = placed(vertex);

  const std::array<dmrp_vec2, 4> corners = {placed({0.0, 0.0}), placed({size.x, 0.0}), placed(size),
                                            placed({0.0, size.y})};
  out.world = {corners[0], corners[0]};
  for (const dmrp_vec2 p : corners) {
    out.world.lower = {std::min(out.world.lower.x, p.x), std::min(out.world.lower.y, p.y)};
    out.world.upper = {std::max(out.world.upper.x, p.x), std::max(out.world.upper.y, p.y)};
  }
  append_corners(corners, out);
  return out;
}

PlanningGrid planning_grid_of(const CellMap& map, double cell_m) {
  assert(map.free.size() == std::size_t{map.width} * map.height && cell_m > 0.0);
  PlanningGrid grid;
  grid.width = map.width;
  grid.height = map.height;
  grid.resolution_m = cell_m;
  grid.free = map.free;
  grid.edges.assign(map.free.size(), 0);
  grid.clearance.assign(map.free.size(), 0.0f);
  find_clearances(map, grid);

  const dmrp_grid sdk_grid = grid.view();
  const toolkit::GridView view(sdk_grid);
  for (std::uint32_t index = 0; index < view.size(); ++index) {
    if (!view.free(index)) continue;
    const toolkit::Cell from = view.cell(index);
    for (int direction = 0; direction < toolkit::direction_count; ++direction) {
      const auto d = static_cast<std::size_t>(direction);
      const toolkit::Cell to = {from.column + toolkit::direction_dx[d], from.row + toolkit::direction_dy[d]};
      if (view.free(to) && view.free(toolkit::Cell{to.column, from.row}) &&
          view.free(toolkit::Cell{from.column, to.row}))
        grid.edges[index] = static_cast<std::uint8_t>(grid.edges[index] | 1u << direction);
    }
  }
  return grid;
}

}  // namespace dmrp::core
