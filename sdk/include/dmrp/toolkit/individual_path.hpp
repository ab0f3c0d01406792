// SPDX-License-Identifier: MIT
// individual_path.hpp: a robot's own shortest path by straight moves, a cell a step, and where two such paths conflict.
// They are the root of a search for conflict-free plans, before anybody gives way.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "grid_view.hpp"

namespace dmrp::toolkit {

using CellPath = std::vector<std::uint32_t>;  // the cell at step 0, 1, ...; at its end the robot rests

DMRP_LOCAL inline constexpr std::uint32_t no_way = std::numeric_limits<std::uint32_t>::max();
DMRP_LOCAL inline constexpr int straight_stride = 2;  // every second of the eight directions is one

// The number of straight moves from each cell to the goal, over cells that are not closed; `no_way` without a way.
// A `start` limits this to its own cell and those nearer to the goal; others may have `no_way`, too.
inline std::vector<std::uint32_t> straight_steps_to(const GridView& grid, std::uint32_t goal,
                                                    const std::vector<bool>& closed, std::uint32_t start = no_cell) {
  assert(goal < grid.size() && closed.size() == grid.size());
  std::vector<std::uint32_t> steps(grid.size(), no_way);
  std::vector<std::uint32_t> queue = {goal};
  steps[goal] = 0;
  for (std::size_t next = 0; next < queue.size() && queue[next] != start; ++next)
    for (int direction = 0; direction < direction_count; direction += straight_stride) {
      if (!grid.edge(queue[next], direction)) continue;
      const std::uint32_t other = grid.neighbour(queue[next], direction);
      if (steps[other] != no_way || closed[other]) continue;
      steps[other] = steps[queue[next]] + 1;
      queue.push_back(other);
    }
  return steps;
}

// The shortest path that keeps its direction as long as it can; the start alone if there is no way. `steps`: to its goal.
inline CellPath individual_path(const GridView& grid, std::uint32_t start, const std::vector<std::uint32_t>& steps) {
  CellPath path = {start};
  int heading = 0;
  while (steps[path.back()] != no_way && steps[path.back()] > 0) {
    const auto leads_on = [&](int direction) {
      return grid.edge(path.back(), direction) &&
             steps[grid.neighbour(path.back(), direction)] + 1 == steps[path.back()];
    };
    for (int turn = 0; turn < direction_count && !leads_on(heading); turn += straight_stride)
      heading = (heading + straight_stride) % direction_count;
    path.push_back(grid.neighbour(path.back(), heading));
  }
  return path;
}

inline std::uint32_t at_step(const CellPath& path, std::size_t step) {
  return path[std::min(step, path.size() - 1)];
}

// Calls visit(a's cell, b's cell) for each step at which the two are on one cell, or begin to exchange their cells.
template <class Visit>
void for_each_conflict(const CellPath& a, const CellPath& b, Visit&& visit) {
  for (std::size_t step = 0; step < std::max(a.size(), b.size()); ++step) {
    const std::uint32_t cell_a = at_step(a, step);
    const std::uint32_t cell_b = at_step(b, step);
    if (cell_a == cell_b || (cell_a == at_step(b, step + 1) && cell_b == at_step(a, step + 1))) visit(cell_a, cell_b);
  }
}

}  // namespace dmrp::toolkit
