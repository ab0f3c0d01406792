// SPDX-License-Identifier: MIT
// grid_view.hpp: access to a dmrp_grid by cells, indices and points. See ../grid.h for the layout.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "../grid.h"

namespace dmrp::toolkit {

// Column and row, from the lower left. May lie outside a grid.
struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;
};

constexpr bool operator==(Cell a, Cell b) {
  return a.column == b.column && a.row == b.row;
}
constexpr bool operator!=(Cell a, Cell b) {
  return !(a == b);
}

// Directions have the numbers of the bits of an edge mask, counter-clockwise from +x: E, NE, N, NW, W, SW, S, SE.
DMRP_LOCAL inline constexpr int direction_count = 8;
DMRP_LOCAL inline constexpr std::array<std::int32_t, 8> direction_dx = {1, 1, 0, -1, -1, -1, 0, 1};
DMRP_LOCAL inline constexpr std::array<std::int32_t, 8> direction_dy = {0, 1, 1, 1, 0, -1, -1, -1};
DMRP_LOCAL inline constexpr std::array<double, 8> direction_length = {
    1.0, 1.4142135623730951, 1.0, 1.4142135623730951, 1.0, 1.4142135623730951, 1.0, 1.4142135623730951};  // in cells

constexpr bool is_diagonal(int direction) {
  return (direction & 1) != 0;
}
constexpr int opposite_direction(int direction) {
  return (direction + 4) & 7;
}

// The direction of a step to one of the eight neighbours; -1 for no step or a longer one.
constexpr int direction_of(std::int32_t dx, std::int32_t dy) {
  for (int direction = 0; direction < direction_count; ++direction)
    if (direction_dx[static_cast<std::size_t>(direction)] == dx &&
        direction_dy[static_cast<std::size_t>(direction)] == dy)
      return direction;
  return -1;
}

// An index that no cell of any grid has.
DMRP_LOCAL inline constexpr std::uint32_t no_cell = 0xFFFFFFFFu;

// A cheap view. The grid's arrays must outlive it; the struct dmrp_grid need not.
// An index passed to a function must be that of a cell in the grid.
class GridView {
 public:
  GridView() = default;
  explicit GridView(const dmrp_grid& grid)
      : width_(grid.width),
        height_(grid.height),
        resolution_m_(grid.resolution_m),
        origin_(grid.origin),
        free_(grid.free),
        edges_(grid.edges),
        clearance_(grid.clearance) {}

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint32_t size() const { return width_ * height_; }  // in cells
  double resolution_m() const { return resolution_m_; }
  dmrp_vec2 lower() const { return origin_; }
  dmrp_vec2 upper() const { return {origin_.x + width_ * resolution_m_, origin_.y + height_ * resolution_m_}; }

  bool contains(Cell cell) const {
    return cell.column >= 0 && cell.row >= 0 && static_cast<std::uint32_t>(cell.column) < width_ &&
           static_cast<std::uint32_t>(cell.row) < height_;
  }
  bool contains(dmrp_vec2 point) const { return contains(cell_of(point)); }

  std::uint32_t index(Cell cell) const {
    assert(contains(cell));
    return static_cast<std::uint32_t>(cell.row) * width_ + static_cast<std::uint32_t>(cell.column);
  }
  std::uint32_t column(std::uint32_t cell) const { return cell % width_; }
  std::uint32_t row(std::uint32_t cell) const { return cell / width_; }
  Cell cell(std::uint32_t index) const {
    assert(index < size());
    return {static_cast<std::int32_t>(column(index)), static_cast<std::int32_t>(row(index))};
  }

  // The cell that contains the point, in the grid or outside; a point on a common border belongs to the upper or right
  // cell. NaN gives a cell outside.
  Cell cell_of(dmrp_vec2 point) const {
    return {whole((point.x - origin_.x) / resolution_m_), whole((point.y - origin_.y) / resolution_m_)};
  }

  // The index of the cell that contains the point; no_cell outside the grid.
  std::uint32_t index_of(dmrp_vec2 point) const {
    const Cell at = cell_of(point);
    return contains(at) ? index(at) : no_cell;
  }

  dmrp_vec2 center(Cell cell) const {
    return {origin_.x + (cell.column + 0.5) * resolution_m_, origin_.y + (cell.row + 0.5) * resolution_m_};
  }
  dmrp_vec2 center(std::uint32_t index) const { return center(cell(index)); }

  bool free(std::uint32_t index) const { return free_[index] != 0; }
  bool free(Cell cell) const { return contains(cell) && free(index(cell)); }

  // All eight edges of a cell, as bits DMRP_EDGE_*, and one of them.
  std::uint8_t edges(std::uint32_t index) const { return edges_[index]; }
  bool edge(std::uint32_t index, int direction) const { return (edges_[index] >> direction & 1) != 0; }

  // The neighbouring cell, whether or not an edge leads there; no_cell outside the grid.
  std::uint32_t neighbour(std::uint32_t index, int direction) const {
    assert(direction >= 0 && direction < direction_count);
    const auto d = static_cast<std::size_t>(direction);
    const Cell from = cell(index);
    const Cell to = {from.column + direction_dx[d], from.row + direction_dy[d]};
    return contains(to) ? this->index(to) : no_cell;
  }

  // m, at the cell's centre.
  float clearance(std::uint32_t index) const { return clearance_[index]; }

 private:
  static std::int32_t whole(double cells) {
    if (!(cells >= 0.0))
      return cells < -1e9 || std::isnan(cells) ? -1000000000 : static_cast<std::int32_t>(std::floor(cells));
    return static_cast<std::int32_t>(std::min(cells, 1e9));
  }

  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  double resolution_m_ = 1.0;
  dmrp_vec2 origin_ = {0.0, 0.0};
  const std::uint8_t* free_ = nullptr;
  const std::uint8_t* edges_ = nullptr;
  const float* clearance_ = nullptr;
};

}  // namespace dmrp::toolkit
