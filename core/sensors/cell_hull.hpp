// SPDX-License-Identifier: MIT
// cell_hull.hpp: convex hulls of grid cells, computed exactly in whole cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace dmrp::core {

struct LatticeCell {
  std::int64_t column;
  std::int64_t row;
};

constexpr std::int64_t dot(const LatticeCell& a, const LatticeCell& b) {
  return a.column * b.column + a.row * b.row;
}
constexpr std::int64_t cross(const LatticeCell& a, const LatticeCell& b) {
  return a.column * b.row - a.row * b.column;
}
constexpr LatticeCell between(const LatticeCell& from, const LatticeCell& to) {
  return {to.column - from.column, to.row - from.row};
}

// In row-major order.
constexpr bool precedes(const LatticeCell& a, const LatticeCell& b) {
  return a.row != b.row ? a.row < b.row : a.column < b.column;
}

// The line between the two vertices of a hull that are farthest from each other. Lengths in cells.
struct Chord {
  LatticeCell from;
  LatticeCell along;  // the vector to the other end
  double length;
  double left;  // the largest distance of a vertex on either side
  double right;
  LatticeCell farthest;  // the vertex with the larger of these distances

  double deviation() const { return std::max(left, right); }
};

// The columns from `first` to `last`.
struct ColumnRange {
  std::int64_t first;
  std::int64_t last;
};

// The vertices of the convex hull, counter-clockwise, without collinear ones. `cells` are in row-major order. One or
// two cells give one or two vertices.
void find_hull(std::span<const LatticeCell> cells, std::vector<LatticeCell>& hull);

Chord longest_chord(std::span<const LatticeCell> hull);

// Twice the area of the hull.
std::int64_t doubled_area(std::span<const LatticeCell> hull);

// The columns that the hull covers, wholly or in part, between the centres of `row` and of the next row. The hull must
// reach both rows.
ColumnRange columns_beside(std::span<const LatticeCell> hull, std::int64_t row);

// Removes vertices that lie at most `tolerance` cells off the new outline. `scratch` is overwritten.
void drop_flat_vertices(std::vector<LatticeCell>& hull, std::vector<LatticeCell>& scratch, double tolerance);

}  // namespace dmrp::core
