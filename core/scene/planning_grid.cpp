// SPDX-License-Identifier: MIT
#include "core/scene/planning_grid.hpp"

#include <cassert>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>

#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

using toolkit::Cell;
using toolkit::GridView;

// The number of cells that cover a length. An excess of at most 1e-6 cells does not need another cell.
std::uint32_t cells_across(double length_m, double resolution_m) {
  return static_cast<std::uint32_t>(std::ceil(length_m / resolution_m - 1e-6));
}

bool move_is_free(const StaticGeometry& geometry, const GridView& grid, Cell from, int direction, double radius_m) {
  const auto d = static_cast<std::size_t>(direction);
  const Cell to = {from.column + toolkit::direction_dx[d], from.row + toolkit::direction_dy[d]};
  if (!grid.free(to)) return false;
  if (toolkit::is_diagonal(direction)) {
    if (!grid.free(Cell{to.column, from.row}) || !grid.free(Cell{from.column, to.row})) return false;
  }
  // With enough clearance the sweep is free.
  const double length_m = toolkit::direction_length[d] * grid.resolution_m();
  if (static_cast<double>(grid.clearance(grid.index(from))) > radius_m + length_m) return true;
  return geometry.sweep_is_free(grid.center(from), grid.center(to), radius_m);
}

void find_edges(const StaticGeometry& geometry, double radius_m, PlanningGrid& grid) {
  const dmrp_grid sdk_grid = grid.view();
  const GridView view(sdk_grid);
  for (std::uint32_t index = 0; index < view.size(); ++index) {
    if (!view.free(index)) continue;
    // Half of the directions suffice: edges are mutual.
    for (int direction = 0; direction < 4; ++direction) {
      if (!move_is_free(geometry, view, view.cell(index), direction, radius_m)) continue;
      const std::uint32_t other = view.neighbour(index, direction);
      grid.edges[index] = static_cast<std::uint8_t>(grid.edges[index] | 1u << direction);
      grid.edges[other] = static_cast<std::uint8_t>(grid.edges[other] | 1u << toolkit::opposite_direction(direction));
    }
  }
}

}  // namespace

dmrp_grid PlanningGrid::view() const {
  assert(free.size() == std::size_t{width} * height && edges.size() == free.size());
  dmrp_grid grid{};
  grid.struct_size = sizeof(grid);
  grid.width = width;
  grid.height = height;
  grid.resolution_m = resolution_m;
  grid.origin = origin;
  grid.free = free.data();
  grid.edges = edges.data();
  grid.clearance = clearance.data();
  return grid;
}

PlanningGrid build_planning_grid(const StaticGeometry& geometry, double resolution_m, double radius_m,
                                 double margin_m) {
  assert(resolution_m > 0.0 && radius_m >= 0.0);
  PlanningGrid grid;
  grid.width = cells_across(geometry.upper().x - geometry.lower().x, resolution_m);
  grid.height = cells_across(geometry.upper().y - geometry.lower().y, resolution_m);
  grid.resolution_m = resolution_m;
  grid.origin = geometry.lower();
  const std::size_t size = std::size_t{grid.width} * grid.height;
  grid.free.assign(size, 0);
  grid.edges.assign(size, 0);
  grid.clearance.assign(size, 0.0f);
  grid.at_open_edge.assign(geometry.has_open_edge() ? size : 0, 0);

  const dmrp_grid sdk_grid = grid.view();
  const GridView view(sdk_grid);
  for (std::uint32_t index = 0; index < size; ++index) {
    const NearestShape nearest = geometry.nearest(view.center(index));
    grid.clearance[index] = static_cast<float>(nearest.clearance_m);
    grid.free[index] = nearest.clearance_m > 0.0 && nearest.clearance_m >= radius_m + margin_m - touching_m ? 1 : 0;
    if (geometry.has_open_edge()) grid.at_open_edge[index] = geometry.is_open_edge(nearest.shape) ? 1 : 0;
  }
  find_edges(geometry, radius_m, grid);
  return grid;
}

std::vector<bool> reachable_cells(const PlanningGrid& grid, std::uint32_t from, const std::vector<bool>& closed) {
  assert(from < grid.free.size() && (closed.empty() || closed.size() == grid.free.size()));
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  std::vector<bool> seen(view.size());
  std::vector<std::uint32_t> open = {from};
  seen[from] = true;
  while (!open.empty()) {
    const std::uint32_t cell = open.back();
    open.pop_back();
    for (int direction = 0; direction < 8; direction += 2) {
      if (!view.edge(cell, direction)) continue;
      const std::uint32_t next = view.neighbour(cell, direction);
      if (!seen[next] && (closed.empty() || !closed[next])) {
        seen[next] = true;
        open.push_back(next);
      }
    }
  }
  return seen;
}

}  // namespace dmrp::core
