// SPDX-License-Identifier: MIT
#include "core/sensors/cell_hull.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace dmrp::core {
namespace {

std::int64_t floor_of_quotient(std::int64_t dividend, std::int64_t divisor) {
  return dividend >= 0 ? dividend / divisor : -((-dividend + divisor - 1) / divisor);
}

}  // namespace

// Andrew's monotone chain: the row-major order is the order that it needs. Up the right side, down the left.
void find_hull(std::span<const LatticeCell> cells, std::vector<LatticeCell>& hull) {
  assert(std::is_sorted(cells.begin(), cells.end(), precedes));
  hull.clear();
  const auto extend = [&](const LatticeCell& cell, std::size_t least) {
    while (hull.size() > least && cross(between(hull[hull.size() - 2], hull.back()), between(hull.back(), cell)) <= 0)
      hull.pop_back();
    hull.push_back(cell);
  };
  for (const LatticeCell& cell : cells) extend(cell, 1);
  const std::size_t right_side = hull.size();
  if (right_side == 1) return;
  for (std::size_t i = cells.size() - 1; i-- > 0;) extend(cells[i], right_side);
  hull.pop_back();  // the first vertex again
}

Chord longest_chord(std::span<const LatticeCell> hull) {
  assert(!hull.empty());
  Chord chord{};
  std::int64_t longest = -1;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    for (std::size_t j = i + 1; j < hull.size(); ++j) {
      const LatticeCell along = between(hull[i], hull[j]);
      if (dot(along, along) <= longest) continue;
      longest = dot(along, along);
      chord.from = hull[i];
      chord.along = along;
    }
  }
  chord.length = std::sqrt(static_cast<double>(longest));
  chord.farthest = chord.from;
  for (const LatticeCell& vertex : hull) {
    const double off = static_cast<double>(cross(chord.along, between(chord.from, vertex))) / chord.length;
    if (std::abs(off) > chord.deviation()) chord.farthest = vertex;
    chord.left = std::max(chord.left, off);
    chord.right = std::max(chord.right, -off);
  }
  return chord;
}

std::int64_t doubled_area(std::span<const LatticeCell> hull) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) area += cross(hull[i], hull[(i + 1) % hull.size()]);
  return area;
}

// No vertex lies between the two rows, so the sides of the hull are straight there.
ColumnRange columns_beside(std::span<const LatticeCell> hull, std::int64_t row) {
  ColumnRange range = {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const LatticeCell& one = hull[i];
    const LatticeCell& other = hull[(i + 1) % hull.size()];
    const LatticeCell& low = one.row < other.row ? one : other;
    const LatticeCell& high = one.row < other.row ? other : one;
    if (low.row > row || high.row <= row) continue;
    const LatticeCell along = between(low, high);
    for (const std::int64_t at : {row, row + 1}) {
      const std::int64_t aside = along.column * (at - low.row);
      range.first = std::min(range.first, low.column + floor_of_quotient(aside, along.row));
      range.last = std::max(range.last, low.column - floor_of_quotient(-aside, along.row));
    }
  }
  assert(range.first <= range.last);  // otherwise the hull does not reach both rows
  return range;
}

// From each vertex that stays it goes to the farthest one for which all between are flat: the cells then are no farther
// from the polygon, which is a part of the hull.
void drop_flat_vertices(std::vector<LatticeCell>& hull, std::vector<LatticeCell>& scratch, double tolerance) {
  assert(!hull.empty() && tolerance >= 0.0);
  scratch.assign(hull.begin(), hull.end());
  scratch.push_back(hull.front());
  hull.clear();
  const auto is_flat = [&](std::size_t first, std::size_t last) {
    const LatticeCell along = between(scratch[first], scratch[last]);
    const double most = tolerance * std::sqrt(static_cast<double>(dot(along, along)));
    for (std::size_t i = first + 1; i < last; ++i) {
      const LatticeCell off = between(scratch[first], scratch[i]);
      if (dot(along, off) < 0 || dot(along, off) > dot(along, along)) return false;
      if (std::abs(static_cast<double>(cross(along, off))) > most) return false;
    }
    return true;
  };
  for (std::size_t first = 0; first + 1 < scratch.size();) {
    hull.push_back(scratch[first]);
    std::size_t last = first + 1;
    while (last + 1 < scratch.size() && is_flat(first, last + 1)) ++last;
    first = last;
  }
}

}  // namespace dmrp::core
