// SPDX-License-Identifier: MIT
// lattice_frame.hpp: where the lattice lies: its cells about the robot.
#ifndef DMRP_CONTROLLERS_E3MOP_LATTICE_FRAME_HPP
#define DMRP_CONTROLLERS_E3MOP_LATTICE_FRAME_HPP

#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::e3mop {

// A square of cells about `center`, the robot's own place, so that the search starts on a lattice point without
// rounding. Cells have indices in rows from the lower left, within a frame of `border` cells that stay blocked, so that
// no motion of that reach needs a bounds check.
struct LatticeFrame {
  static constexpr std::int32_t border = 2;

  dmrp_vec2 center = {0.0, 0.0};
  double resolution_m = 0.1;
  std::int32_t half_cells = 0;  // from the centre to the outermost cells inside

  std::int32_t reach() const { return half_cells + border; }
  std::int32_t stride() const { return 2 * reach() + 1; }
  std::int32_t cell_count() const { return stride() * stride(); }
  std::int32_t center_cell() const { return cell_at(0, 0); }

  // Of a column and a row counted from the centre.
  std::int32_t cell_at(std::int32_t column, std::int32_t row) const {
    return (row + reach()) * stride() + column + reach();
  }
  std::int32_t column_of(std::int32_t cell) const { return cell % stride() - reach(); }
  std::int32_t row_of(std::int32_t cell) const { return cell / stride() - reach(); }
  bool inside(std::int32_t column, std::int32_t row) const {
    return column >= -half_cells && column <= half_cells && row >= -half_cells && row <= half_cells;
  }
  dmrp_vec2 point_of(std::int32_t cell) const {
    return center + resolution_m * dmrp_vec2{static_cast<double>(column_of(cell)), static_cast<double>(row_of(cell))};
  }

  // The cell nearest to a point; -1 outside.
  std::int32_t cell_of(dmrp_vec2 point) const {
    const dmrp_vec2 aside = (point - center) / resolution_m;
    if (!(std::abs(aside.x) < half_cells + 0.5 && std::abs(aside.y) < half_cells + 0.5)) return -1;
    return cell_at(static_cast<std::int32_t>(std::floor(aside.x + 0.5)),
                   static_cast<std::int32_t>(std::floor(aside.y + 0.5)));
  }
};

}  // namespace dmrp::controllers::e3mop

#endif
