// SPDX-License-Identifier: MIT
// lattice_frame.hpp: the position and size of the lattice about the robot.
#pragma once

#include <cmath>
#include <cstdint>
#include <dmrp/cpp/local_controller.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::e3mop {

// A square of cells about `center`, the robot's position: the search starts exactly on a lattice point. Cells are
// indexed row by row from the lower left. A border of `border` blocked cells surrounds the square, so that edges of
// that length need no bounds check.
struct LatticeFrame {
  static constexpr std::int32_t border = 2;

  Vec2 center = {0.0, 0.0};
  double resolution_m = 0.1;
  std::int32_t half_cells = 0;  // from the centre to the outermost cells within the border

  std::int32_t reach() const { return half_cells + border; }
  std::int32_t stride() const { return 2 * reach() + 1; }
  std::int32_t cell_count() const { return stride() * stride(); }
  std::int32_t center_cell() const { return cell_at(0, 0); }

  // The cell at a column and a row counted from the centre.
  std::int32_t cell_at(std::int32_t column, std::int32_t row) const {
    return (row + reach()) * stride() + column + reach();
  }
  std::int32_t column_of(std::int32_t cell) const { return cell % stride() - reach(); }
  std::int32_t row_of(std::int32_t cell) const { return cell / stride() - reach(); }
  bool inside(std::int32_t column, std::int32_t row) const {
    return column >= -half_cells && column <= half_cells && row >= -half_cells && row <= half_cells;
  }
  Vec2 point_of(std::int32_t cell) const {
    return center + resolution_m * Vec2{static_cast<double>(column_of(cell)), static_cast<double>(row_of(cell))};
  }

  // The cell closest to a point; -1 outside.
  std::int32_t cell_of(Vec2 point) const {
    const Vec2 aside = (point - center) / resolution_m;
    if (!(std::abs(aside.x) < half_cells + 0.5 && std::abs(aside.y) < half_cells + 0.5)) return -1;
    return cell_at(static_cast<std::int32_t>(std::floor(aside.x + 0.5)),
                   static_cast<std::int32_t>(std::floor(aside.y + 0.5)));
  }
};

}  // namespace dmrp::controllers::e3mop
