// SPDX-License-Identifier: MIT
#include "core/execution/goal_distances.hpp"

#include <algorithm>
#include <cstdlib>
#include <dmrp/toolkit/vec2.hpp>
#include <functional>
#include <limits>

namespace dmrp::core {
namespace {

constexpr double unreachable = std::numeric_limits<double>::infinity();

toolkit::Cell beside(toolkit::Cell cell, int direction) {
  const auto d = static_cast<std::size_t>(direction);
  return {cell.column + toolkit::direction_dx[d], cell.row + toolkit::direction_dy[d]};
}

}  // namespace

GoalDistances::GoalDistances(const toolkit::GridView& grid, dmrp_vec2 goal)
    : grid_(grid),
      goal_(goal),
      goal_cell_(grid.cell_of(goal)),
      tile_columns_((grid.width() + tile_cells - 1) / tile_cells),
      tiles_(std::size_t{tile_columns_} * ((grid.height() + tile_cells - 1) / tile_cells)) {}

double GoalDistances::from(dmrp_vec2 point) {
  const toolkit::Cell own = grid_.cell_of(point);
  double least_m = unreachable;
  const auto by = [&](toolkit::Cell cell) {
    if (cell == goal_cell_) least_m = std::min(least_m, toolkit::distance(point, goal_));
    least_m = std::min(least_m, settle(cell) + toolkit::distance(point, grid_.center(cell)));
  };
  const bool is_free = grid_.free(own);
  if (is_free) by(own);
  for (int d = 0; d < toolkit::direction_count; ++d) {
    const toolkit::Cell cell = beside(own, d);
    // pushed off the grid's free cells, a robot counts from whichever is nearest
    if (grid_.free(cell) && (!is_free || grid_.edge(grid_.index(own), d))) by(cell);
  }
  return least_m;
}

double GoalDistances::settle(toolkit::Cell cell) {
  if (!aims_) {
    aims_ = true;
    aim_ = cell;
    const auto widest = static_cast<std::int32_t>(std::max(grid_.width(), grid_.height()));
    for (std::int32_t ring = 0; queue_.empty() && ring <= widest; ++ring)
      for (std::int32_t row = goal_cell_.row - ring; row <= goal_cell_.row + ring; ++row)
        for (std::int32_t column = goal_cell_.column - ring; column <= goal_cell_.column + ring; ++column)
          if (grid_.free(toolkit::Cell{column, row}))
            offer({column, row}, toolkit::distance(grid_.center(toolkit::Cell{column, row}), goal_));
  }
  const Node asked = node(cell);
  while ((asked.settled & asked.bit) == 0 && !queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
    const std::uint32_t index = queue_.back().second;
    queue_.pop_back();
    const toolkit::Cell next = grid_.cell(index);
    const Node it = node(next);
    if ((it.settled & it.bit) != 0) continue;
    it.settled |= it.bit;
    for (int d = 0; d < toolkit::direction_count; ++d)
      if (grid_.edge(index, d))
        offer(beside(next, d),
              static_cast<double>(it.to_goal_m) + grid_.resolution_m() * toolkit::direction_length.at(d));
  }
  return (asked.settled & asked.bit) != 0 ? static_cast<double>(asked.to_goal_m) : unreachable;
}

void GoalDistances::offer(toolkit::Cell cell, double to_goal_m) {
  const Node it = node(cell);
  if ((it.settled & it.bit) != 0 || static_cast<float>(to_goal_m) >= it.to_goal_m) return;
  it.to_goal_m = static_cast<float>(to_goal_m);
  queue_.emplace_back(to_goal_m + estimate_m(cell), grid_.index(cell));
  std::push_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
}

GoalDistances::Node GoalDistances::node(toolkit::Cell cell) {
  const auto column = static_cast<std::uint32_t>(cell.column);
  const auto row = static_cast<std::uint32_t>(cell.row);
  std::unique_ptr<Tile>& tile = tiles_[row / tile_cells * tile_columns_ + column / tile_cells];
  if (!tile) {
    tile = std::make_unique<Tile>();
    tile->to_goal_m.fill(std::numeric_limits<float>::infinity());
  }
  const std::uint32_t place = row % tile_cells * tile_cells + column % tile_cells;
  return {tile->to_goal_m[place], tile->settled, std::uint64_t{1} << place};
}

// To the cell at which the search aims, without obstacles: eight directions.
double GoalDistances::estimate_m(toolkit::Cell cell) const {
  const auto [few, many] = std::minmax({std::abs(cell.column - aim_.column), std::abs(cell.row - aim_.row)});
  return grid_.resolution_m() * (many - few + few * toolkit::direction_length[1]);
}

std::shared_ptr<GoalDistances> GoalDistancesCache::to(const dmrp_grid& grid, dmrp_vec2 goal) {
  std::weak_ptr<GoalDistances>& known = known_[{grid.free, goal.x, goal.y}];
  std::shared_ptr<GoalDistances> distances = known.lock();
  if (!distances) known = distances = std::make_shared<GoalDistances>(toolkit::GridView(grid), goal);
  return distances;
}

}  // namespace dmrp::core
