// SPDX-License-Identifier: MIT
#include "core/execution/goal_distances.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

namespace dmrp::core {

GoalDistances::GoalDistances(const toolkit::GridView& grid, dmrp_vec2 goal, toolkit::NavigationField& scratch)
    : grid_(grid), goal_(goal), goal_cell_(grid.cell_of(goal)) {
  scratch.compute(grid, {goal, goal});
  to_goal_m_.reserve(grid.size());
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    to_goal_m_.push_back(static_cast<float>(scratch.value(cell)));
}

double GoalDistances::from(dmrp_vec2 point) const {
  const toolkit::Cell own = grid_.cell_of(point);
  double least_m = std::numeric_limits<double>::infinity();
  const auto by = [&](toolkit::Cell cell) {
    if (cell == goal_cell_) least_m = std::min(least_m, toolkit::distance(point, goal_));
    const std::uint32_t index = grid_.index(cell);
    least_m = std::min(least_m, static_cast<double>(to_goal_m_[index]) + toolkit::distance(point, grid_.center(cell)));
  };
  const bool is_free = grid_.free(own);
  if (is_free) by(own);
  for (int d = 0; d < toolkit::direction_count; ++d) {
    const toolkit::Cell beside = {own.column + toolkit::direction_dx[static_cast<std::size_t>(d)],
                                  own.row + toolkit::direction_dy[static_cast<std::size_t>(d)]};
    // pushed off the grid's free cells, a robot counts from whichever is nearest
    if (grid_.free(beside) && (!is_free || grid_.edge(grid_.index(own), d))) by(beside);
  }
  return least_m;
}

std::shared_ptr<const GoalDistances> GoalDistancesCache::to(const dmrp_grid& grid, dmrp_vec2 goal) {
  const toolkit::GridView view(grid);
  auto& distances = known_[{grid.free, view.index_of(goal)}];
  if (!distances) distances = std::make_shared<GoalDistances>(view, goal, scratch_);
  return distances;
}

}  // namespace dmrp::core
