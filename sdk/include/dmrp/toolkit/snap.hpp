// SPDX-License-Identifier: MIT
// snap.hpp: assigns robots at any position to cells of a planning grid, for planning from their present poses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "disc_sweep.hpp"
#include "grid_view.hpp"
#include "rectangle.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

struct SnapRequest {
  dmrp_vec2 position = {0.0, 0.0};
  std::uint32_t preferred = no_cell;  // the next cell of the plan in force, if there is one
};

// The nearest free cell to `position`, by its centre, within `reach_m`, to which `can_move(from, to)` allows a straight
// motion; the lowest index among equals; no_cell if there is none.
template <class CanMove>
std::uint32_t nearest_free_cell(const GridView& grid, dmrp_vec2 position, double reach_m, const CanMove& can_move) {
  struct Candidate {
    double squared_distance;
    std::uint32_t cell;
  };
  const dmrp_vec2 reach = {reach_m, reach_m};
  const Cell lower = grid.cell_of(position - reach);
  const Cell upper = grid.cell_of(position + reach);
  std::vector<Candidate> candidates;
  for (std::int32_t row = std::max(lower.row, 0); row <= upper.row && grid.contains(Cell{0, row}); ++row) {
    for (std::int32_t column = std::max(lower.column, 0); column <= upper.column; ++column) {
      const Cell cell = {column, row};
      if (!grid.contains(cell)) break;
      const double squared = squared_distance(grid.center(cell), position);
      if (grid.free(cell) && squared <= reach_m * reach_m) candidates.push_back({squared, grid.index(cell)});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.squared_distance != b.squared_distance ? a.squared_distance < b.squared_distance : a.cell < b.cell;
  });
  for (const Candidate& candidate : candidates)
    if (can_move(position, grid.center(candidate.cell))) return candidate.cell;
  return no_cell;
}

// One cell per request, all different: the preferred cell if it is free, no other request prefers it and a straight
// motion to it is possible; otherwise the nearest free cell with a straight motion. Empty if a robot has no such cell
// within `reach_m` or two robots would share one; the plan in force is then the better choice. Does not depend on the
// order of the requests. `grid_of(i)` is the grid of request i; the grids differ at most in their free cells.
// `can_move(i, from, to)` tells whether its robot can move straight.
template <class GridOf, class CanMove>
std::optional<std::vector<std::uint32_t>> snap_to_own_cells(const GridOf& grid_of,
                                                            const std::vector<SnapRequest>& requests, double reach_m,
                                                            const CanMove& can_move) {
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const SnapRequest& request = requests[i];
    const GridView grid = grid_of(i);
    const auto i_can_move = [&](dmrp_vec2 from, dmrp_vec2 to) { return can_move(i, from, to); };
    const auto prefers_it = [&](const SnapRequest& other) { return other.preferred == request.preferred; };
    const bool takes_it = request.preferred != no_cell && grid.free(request.preferred) &&
                          std::count_if(requests.begin(), requests.end(), prefers_it) == 1 &&
                          i_can_move(request.position, grid.center(request.preferred));
    cells.push_back(takes_it ? request.preferred : nearest_free_cell(grid, request.position, reach_m, i_can_move));
    if (cells.back() == no_cell) return std::nullopt;
  }
  std::vector<std::uint32_t> sorted = cells;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) return std::nullopt;
  return cells;
}

// The same with one grid, and one rule of motion, for all.
template <class CanMove>
std::optional<std::vector<std::uint32_t>> snap_to_cells(const GridView& grid, const std::vector<SnapRequest>& requests,
                                                        double reach_m, const CanMove& can_move) {
  return snap_to_own_cells([&](std::size_t) { return grid; }, requests, reach_m,
                           [&](std::size_t, dmrp_vec2 from, dmrp_vec2 to) { return can_move(from, to); });
}

// The same for discs among static shapes: a straight motion is possible if the disc swept to the cell's centre stays
// clear, or comes no closer to anything than it starts. `shapes` is any range of dmrp_shape.
template <class Shapes>
std::optional<std::vector<std::uint32_t>> snap_to_cells(const GridView& grid, const std::vector<SnapRequest>& requests,
                                                        double reach_m, double radius_m, const Shapes& shapes,
                                                        const Rectangle& border) {
  return snap_to_cells(grid, requests, reach_m, [&](dmrp_vec2 from, dmrp_vec2 to) {
    return disc_retreat_is_clear({from, to}, radius_m, shapes, border);
  });
}

}  // namespace dmrp::toolkit
