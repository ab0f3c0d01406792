// SPDX-License-Identifier: MIT
// theta_star.hpp: nearly shortest ways of a disc over the cells of a grid, to compare the exact ones with.
//
// Theta* (Nash, Daniel, Koenig and Felner, AAAI 2007; Daniel et al., JAIR 39, 2010): A* over the cells of a grid whose
// nodes may have any earlier node in line of sight as parent, so ways bend only at corners and do not follow the grid.
// The found length is within about 1 % of the shortest. A cell is open if its centre is at least the disc's radius away
// from every shape. Starts and goals keep their exact positions; their cells count as open.
#pragma once

#include <algorithm>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace dmrp::test {

class ThetaStar {
 public:
  // The grid must outlive this object.
  explicit ThetaStar(const Grid& grid) : grid_(grid) {}

  // NaN if there is no way.
  double length(Vec2 from, Vec2 to, double radius_m) {
    radius_m_ = radius_m;
    from_ = from;
    to_ = to;
    first_ = grid_.index_of(from);
    last_ = grid_.index_of(to);
    if (first_ == toolkit::no_cell || last_ == toolkit::no_cell) return undefined;
    if (is_in_sight(from, to)) return toolkit::distance(from, to);

    lengths_m_.assign(grid_.size(), std::numeric_limits<double>::infinity());
    parents_.assign(grid_.size(), toolkit::no_cell);
    settled_.assign(grid_.size(), 0);
    queue_.clear();
    lengths_m_[first_] = 0.0;
    parents_[first_] = first_;
    queue_.emplace_back(toolkit::distance(from, to), first_);
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
      const std::uint32_t cell = queue_.back().second;
      queue_.pop_back();
      if (settled_[cell]) continue;
      settled_[cell] = 1;
      if (cell == last_) return lengths_m_[cell];
      expand(cell);
    }
    return undefined;
  }

 private:
  using Entry = std::pair<double, std::uint32_t>;  // estimated length of the whole way, cell

  bool open(std::uint32_t cell) const {
    return static_cast<double>(grid_.clearance(cell)) >= radius_m_ || cell == first_ || cell == last_;
  }

  bool is_in_sight(Vec2 from, Vec2 to) const {
    return toolkit::for_each_cell_on_line(
        grid_, from, to, [&](toolkit::Cell cell) { return grid_.contains(cell) && open(grid_.index(cell)); });
  }

  Vec2 position_of(std::uint32_t cell) const {
    if (cell == first_) return from_;
    if (cell == last_) return to_;
    return grid_.center(cell);
  }

  void expand(std::uint32_t cell) {
    const std::uint32_t parent = parents_[cell];
    for (int direction = 0; direction < toolkit::direction_count; ++direction) {
      const std::uint32_t next = grid_.neighbour(cell, direction);
      if (next == toolkit::no_cell || settled_[next] || !open(next)) continue;
      // directly from the parent if it is in sight, otherwise from the cell
      for (const std::uint32_t from : {parent, cell}) {
        if (!is_in_sight(position_of(from), position_of(next))) continue;
        const double length_m = lengths_m_[from] + toolkit::distance(position_of(from), position_of(next));
        if (length_m < lengths_m_[next]) {
          lengths_m_[next] = length_m;
          parents_[next] = from;
          queue_.emplace_back(length_m + toolkit::distance(position_of(next), to_), next);
          std::push_heap(queue_.begin(), queue_.end(), std::greater<Entry>());
        }
        break;
      }
    }
  }

  toolkit::GridView grid_;
  double radius_m_ = 0.0;
  Vec2 from_ = {0.0, 0.0};
  Vec2 to_ = {0.0, 0.0};
  std::uint32_t first_ = 0;
  std::uint32_t last_ = 0;
  std::vector<double> lengths_m_;       // by cell: of the best way found so far
  std::vector<std::uint32_t> parents_;  // by cell
  std::vector<std::uint8_t> settled_;   // by cell
  std::vector<Entry> queue_;
};

}  // namespace dmrp::test
