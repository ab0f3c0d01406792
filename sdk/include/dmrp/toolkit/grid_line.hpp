// SPDX-License-Identifier: MIT
// grid_line.hpp: the cells of a grid that a straight line crosses.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "grid_view.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

// Calls visit(cell) for every cell from that of `from` to that of `to`, in order, while visit returns true; cells may
// lie outside the grid. If the line passes through a corner, both cells beside the corner are visited too. Returns
// whether all calls returned true. (Amanatides and Woo 1987.)
template <class Visit>
bool for_each_cell_on_line(const GridView& grid, dmrp_vec2 from, dmrp_vec2 to, const Visit& visit) {
  Cell cell = grid.cell_of(from);
  const Cell last = grid.cell_of(to);
  const std::int32_t step_x = to.x < from.x ? -1 : 1;
  const std::int32_t step_y = to.y < from.y ? -1 : 1;
  std::int64_t columns_left = std::abs(std::int64_t{last.column} - cell.column);
  std::int64_t rows_left = std::abs(std::int64_t{last.row} - cell.row);

  // Fractions of the line: at which it leaves the cell through a side, and per cell.
  const double never = std::numeric_limits<double>::infinity();
  const double per_column = columns_left > 0 ? grid.resolution_m() / std::abs(to.x - from.x) : never;
  const double per_row = rows_left > 0 ? grid.resolution_m() / std::abs(to.y - from.y) : never;
  const dmrp_vec2 offset = (from - grid.center(cell)) / grid.resolution_m();  // from the cell's centre, in cells
  double leave_x = columns_left > 0 ? (0.5 - step_x * offset.x) * per_column : never;
  double leave_y = rows_left > 0 ? (0.5 - step_y * offset.y) * per_row : never;

  if (!visit(cell)) return false;
  while (columns_left > 0 || rows_left > 0) {
    const bool corner = columns_left > 0 && rows_left > 0 && std::abs(leave_x - leave_y) < 1e-12;
    if (corner && (!visit(Cell{cell.column + step_x, cell.row}) || !visit(Cell{cell.column, cell.row + step_y})))
      return false;
    if (corner || rows_left == 0 || (columns_left > 0 && leave_x < leave_y)) {
      cell.column += step_x;
      leave_x += per_column;
      --columns_left;
      if (corner) {
        cell.row += step_y;
        leave_y += per_row;
        --rows_left;
      }
    } else {
      cell.row += step_y;
      leave_y += per_row;
      --rows_left;
    }
    if (!visit(cell)) return false;
  }
  return true;
}

// Whether every cell on the line is free, and in the grid.
inline bool line_is_free(const GridView& grid, dmrp_vec2 from, dmrp_vec2 to) {
  return for_each_cell_on_line(grid, from, to, [&grid](Cell cell) { return grid.free(cell); });
}

}  // namespace dmrp::toolkit
