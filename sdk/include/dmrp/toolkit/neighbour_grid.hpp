// SPDX-License-Identifier: MIT
// neighbour_grid.hpp: which of many points are near a place, without looking at all of them.
//
// Points are sorted by square cells. The plane of cells is wound up on a torus with about as many cells as there are
// points: memory depends on their number alone, however far apart they are. Far points may so share a cell with near
// ones, and are visited with them: whoever asks compares distances.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "vec2.hpp"

namespace dmrp::toolkit {

// One object can be built again and again; its buffers stay.
class NeighbourGrid {
 public:
  // Sorts the points position_of(0), position_of(1), ..., of fewer than 2^32. Any cell gives the right answers; one as
  // wide as the usual distance of a question gives them fast.
  template <class PositionOf>
  void build(std::size_t count, double cell_m, PositionOf&& position_of) {
    assert(cell_m > 0.0);
    cells_per_m_ = 1.0 / cell_m;
    side_ = 1;
    if (count > few)
      while (static_cast<std::size_t>(side_ * side_) < count) side_ *= 2;
    cells_.resize(count);
    indices_.resize(count);
    begins_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
    for (std::size_t index = 0; index < count; ++index) {
      const dmrp_vec2 place = position_of(index);
      cells_[index] = static_cast<std::uint32_t>(wound(line(place.y)) * side_ + wound(line(place.x)));
      ++begins_[cells_[index]];
    }
    for (std::size_t cell = 1; cell < begins_.size(); ++cell) begins_[cell] += begins_[cell - 1];
    for (std::size_t index = count; index-- > 0;)
      indices_[--begins_[cells_[index]]] = static_cast<std::uint32_t>(index);
  }

  std::size_t size() const { return indices_.size(); }

  // Calls visit(index) once for each point that is at most distance_m away from `center`, whatever the rounding of that
  // comparison, and for some that are farther away. In the order of cells. Gives the number of points visited: if it
  // is size(), a greater distance finds no more.
  template <class Visit>
  std::size_t visit(dmrp_vec2 center, double distance_m, Visit&& visit) const {
    assert(distance_m >= 0.0);
    if (indices_.empty()) return 0;
    const Lines rows = lines(center.y, distance_m);
    const Lines columns = lines(center.x, distance_m);
    std::size_t visited = 0;
    const auto visit_cells = [&](std::int64_t row, std::int64_t from, std::int64_t to) {
      const std::uint32_t begin = begins_[static_cast<std::size_t>(row * side_ + from)];
      const std::uint32_t end = begins_[static_cast<std::size_t>(row * side_ + to) + 1];
      for (std::uint32_t i = begin; i < end; ++i) visit(indices_[i]);
      visited += end - begin;
    };
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      const std::int64_t from = wound(columns.first);
      const std::int64_t to = wound(columns.last);
      if (from <= to) {
        visit_cells(wound(row), from, to);
      } else {
        visit_cells(wound(row), from, side_ - 1);
        visit_cells(wound(row), 0, to);
      }
    }
    return visited;
  }

  // The indices of the same points, in ascending order. They stay until the next call.
  const std::vector<std::uint32_t>& near(dmrp_vec2 center, double distance_m) {
    near_.clear();
    visit(center, distance_m, [this](std::uint32_t index) { near_.push_back(index); });
    if (side_ > 1) std::sort(near_.begin(), near_.end());
    return near_;
  }

 private:
  static constexpr std::size_t few = 16;  // of so few it is faster to look at all

  struct Lines {
    std::int64_t first, last;
  };

  // The column of a coordinate x, the row of a coordinate y, on the plane. Coordinates that are too large for an
  // integer are all in the last one.
  std::int64_t line(double coordinate) const {
    constexpr double farthest = 1e15;
    const double scaled = std::max(-farthest, std::min(farthest, coordinate * cells_per_m_));
    const auto truncated = static_cast<std::int64_t>(scaled);
    return truncated - (static_cast<double>(truncated) > scaled);
  }
  // Those up to distance_m away, and by more than the rounding; no more than there are on the torus.
  Lines lines(double center, double distance_m) const {
    const double reach_m = distance_m + 1e-9 + 1e-12 * (distance_m + std::abs(center));
    const std::int64_t first = line(center - reach_m);
    return {first, std::min(line(center + reach_m), first + side_ - 1)};
  }
  // Winds a line of cells on the torus.
  std::int64_t wound(std::int64_t line) const { return line & (side_ - 1); }

  double cells_per_m_ = 1.0;
  std::int64_t side_ = 1;               // of the torus, in cells; a power of 2
  std::vector<std::uint32_t> cells_;    // by point
  std::vector<std::uint32_t> begins_;   // by cell, of its points in indices_; then size()
  std::vector<std::uint32_t> indices_;  // of points by cell, ascending in each
  std::vector<std::uint32_t> near_;
};

}  // namespace dmrp::toolkit
