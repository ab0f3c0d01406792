// SPDX-License-Identifier: MIT
#include "core/tasks/free_regions.hpp"

#include <algorithm>
#include <dmrp/toolkit/grid_view.hpp>

namespace dmrp::core {
namespace {

constexpr std::uint32_t nowhere = 0xFFFFFFFFu;

double finest(const StaticGeometry& geometry, std::span<const double> resolutions_m, double most_cells) {
  const dmrp_vec2 size = {geometry.upper().x - geometry.lower().x, geometry.upper().y - geometry.lower().y};
  double best_m = *std::max_element(resolutions_m.begin(), resolutions_m.end());
  for (const double cell_m : resolutions_m)
    if (cell_m < best_m && size.x / cell_m * (size.y / cell_m) <= most_cells) best_m = cell_m;
  return best_m;
}

}  // namespace

bool has_other_parts(const PlanningGrid& grid, std::span<const dmrp_vec2> inside) {
  const std::vector<std::uint32_t> part = part_for_tasks(grid, inside);
  if (part.empty()) return false;
  std::vector<bool> known = reachable_cells(grid, part.front());
  for (std::uint32_t cell = 0; cell < grid.at_open_edge.size(); ++cell) {
    if (!grid.at_open_edge[cell] || !grid.free[cell] || known[cell]) continue;
    const std::vector<bool> seen = reachable_cells(grid, cell);
    for (std::size_t other = 0; other < seen.size(); ++other) known[other] = known[other] || seen[other];
  }
  for (std::size_t cell = 0; cell < known.size(); ++cell)
    if (grid.free[cell] && !known[cell]) return true;
  return false;
}

FreeRegions::FreeRegions(const StaticGeometry& geometry, const RobotTypes& types, const SimulationSettings& settings,
                         const DrawnFor& drawn, std::span<const double> resolutions_m, double most_cells)
    : drawn_(drawn) {
  SimulationSettings fine = settings;
  fine.grid_resolution_m = finest(geometry, resolutions_m, most_cells);
  fine_ = PlanningGrids(geometry, types, fine).common(drawn.types);
  double needed_m = 0.0;
  for (const RobotSettings& type : types.all())
    if (drawn.types.empty() || std::count(drawn.types.begin(), drawn.types.end(), type.type) > 0)
      needed_m = std::max(needed_m, planning_clearance_m(type, settings));
  find_regions(part_for_tasks(fine_, drawn.inside), needed_m + 0.5 * settings.grid_resolution_m,
               0.25 * settings.grid_resolution_m * settings.grid_resolution_m);
  spread(static_cast<std::size_t>(0.5 * settings.grid_resolution_m / fine.grid_resolution_m));
  const std::vector<bool> now = reached(PlanningGrids(geometry, types, settings).common(drawn.types));
  hall_ = adjoin_.size();
  for (std::size_t region = 0; region < adjoin_.size(); ++region)
    if (now[region] && is_hall(region)) hall_ = region;
  counted_ = adjoin_.size() - (hall_ < adjoin_.size() ? 1 : 0);
}

// The connected pieces of the part's cells that have such clearance; smaller ones are niches, as before an open door.
void FreeRegions::find_regions(const std::vector<std::uint32_t>& part, double open_m, double niche_m2) {
  std::vector<bool> closed(fine_.free.size(), true);
  for (const std::uint32_t cell : part) closed[cell] = static_cast<double>(fine_.clearance[cell]) < open_m;
  region_.assign(closed.size(), nowhere);
  std::uint32_t regions = 0;
  const dmrp_grid c_grid = fine_.view();
  const toolkit::GridView view(c_grid);
  for (const std::uint32_t first : part) {
    if (closed[first] || region_[first] != nowhere) continue;
    std::vector<std::uint32_t> found = {first};
    region_[first] = regions;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::uint32_t cell = found[i];
      for (int direction = 0; direction < toolkit::direction_count; direction += 2)
        if (view.edge(cell, direction))
          if (const std::uint32_t next = view.neighbour(cell, direction); !closed[next] && region_[next] == nowhere) {
            region_[next] = regions;
            found.push_back(next);
          }
    }
    if (static_cast<double>(found.size()) * fine_.resolution_m * fine_.resolution_m >= niche_m2) {
      ++regions;
      continue;
    }
    for (const std::uint32_t cell : found) {
      region_[cell] = nowhere;
      closed[cell] = true;
    }
  }
  adjoin_.assign(regions, std::vector<bool>(regions));
}

// Gives each cell the region that is the fewest steps away.
void FreeRegions::spread(std::size_t near_steps) {
  const dmrp_grid c_grid = fine_.view();
  const toolkit::GridView view(c_grid);
  std::vector<std::uint32_t> front;
  for (std::uint32_t cell = 0; cell < region_.size(); ++cell)
    if (region_[cell] != nowhere) front.push_back(cell);
  is_near_.assign(region_.size(), false);
  for (std::size_t steps = 0; !front.empty(); ++steps) {
    std::vector<std::uint32_t> next_front;
    for (const std::uint32_t cell : front) {
      is_near_[cell] = steps <= near_steps;
      for (int direction = 0; direction < toolkit::direction_count; direction += 2) {
        if (!view.edge(cell, direction)) continue;
        const std::uint32_t next = view.neighbour(cell, direction);
        if (region_[next] == nowhere) {
          region_[next] = region_[cell];
          next_front.push_back(next);
        } else if (region_[next] != region_[cell]) {
          adjoin_[region_[cell]][region_[next]] = adjoin_[region_[next]][region_[cell]] = true;
        }
      }
    }
    front = std::move(next_front);
  }
}

bool FreeRegions::is_hall(std::size_t region) const {
  const auto neighbours = std::count(adjoin_[region].begin(), adjoin_[region].end(), true);
  return adjoin_.size() > 2 && 2 * static_cast<std::size_t>(neighbours) > adjoin_.size() - 1;
}

std::vector<bool> FreeRegions::reached(const PlanningGrid& grid) const {
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  const dmrp_grid c_fine = fine_.view();
  const toolkit::GridView fine(c_fine);
  std::vector<bool> reached(adjoin_.size());
  for (const std::uint32_t cell : part_for_tasks(grid, drawn_.inside))
    if (const std::uint32_t at = fine.index_of(view.center(cell)); at != toolkit::no_cell && is_near_[at])
      reached[region_[at]] = true;
  return reached;
}

std::size_t FreeRegions::missed(const PlanningGrid& grid) const {
  const std::vector<bool> found = reached(grid);
  std::size_t missed = 0;
  for (std::size_t region = 0; region < found.size(); ++region) missed += region != hall_ && !found[region] ? 1u : 0u;
  return missed;
}

}  // namespace dmrp::core
