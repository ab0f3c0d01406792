// SPDX-License-Identifier: MIT
// goal_distances.hpp: how far a robot still has to go, whatever its plan says.
#pragma once

#include <dmrp/values.h>

#include <cstdint>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/navigation_field.hpp>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace dmrp::core {

// The lengths of the shortest ways to one goal among static obstacles, from every place of a grid.
class GoalDistances {
 public:
  // The way to `goal` through the free cells of `grid`, whose arrays outlive this. `scratch` is overwritten.
  GoalDistances(const toolkit::GridView& grid, dmrp_vec2 goal, toolkit::NavigationField& scratch);

  // Straight to the goal in its cell and beside it, elsewhere by the best of the cells around the point that are
  // connected to it. Infinity where no way leads to the goal.
  double from(dmrp_vec2 point) const;

 private:
  toolkit::GridView grid_;
  dmrp_vec2 goal_;
  toolkit::Cell goal_cell_;
  std::vector<float> to_goal_m_;  // from the cells' centres: four bytes a cell, since each goal has its own
};

// Shared by all robots with the same grid and goal cell.
class GoalDistancesCache {
 public:
  std::shared_ptr<const GoalDistances> to(const dmrp_grid& grid, dmrp_vec2 goal);

 private:
  std::map<std::pair<const std::uint8_t*, std::uint32_t>, std::shared_ptr<const GoalDistances>> known_;
  toolkit::NavigationField scratch_;
};

}  // namespace dmrp::core
