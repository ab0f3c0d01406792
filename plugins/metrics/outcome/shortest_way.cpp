// SPDX-License-Identifier: MIT
#include "metrics/outcome/shortest_way.hpp"

#include <algorithm>
#include <dmrp/toolkit/grid_line.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <functional>
#include <limits>

namespace dmrp::metrics {

double ShortestWay::tour_length(const Robot& robot) {
  double sum_m = 0.0;
  Vec2 at = toolkit::position(robot.start);
  for (const Goal& goal : Span<Goal>(robot.goals, robot.goal_count, robot.goal_stride)) {
    const Vec2 next = toolkit::position(goal.pose);
    sum_m += length(at, next, robot.footprint->radius_m);
    at = next;
  }
  return sum_m;
}

double ShortestWay::length(Vec2 from, Vec2 to, double radius_m) {
  radius_m_ = radius_m;
  from_ = from;
  to_ = to;
  first_ = grid_.index_of(from);
  last_ = grid_.index_of(to);
  if (first_ == toolkit::no_cell || last_ == toolkit::no_cell) return undefined;
  if (is_visible(from, to)) return toolkit::distance(from, to);

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

void ShortestWay::expand(std::uint32_t cell) {
  const std::uint32_t parent = parents_[cell];
  for (int direction = 0; direction < toolkit::direction_count; ++direction) {
    const std::uint32_t next = grid_.neighbour(cell, direction);
    if (next == toolkit::no_cell || settled_[next] || !open(next)) continue;
    // directly from the parent if it is in sight, otherwise from the cell
    for (const std::uint32_t from : {parent, cell}) {
      if (!is_visible(position_of(from), position_of(next))) continue;
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

bool ShortestWay::open(std::uint32_t cell) const {
  return static_cast<double>(grid_.clearance(cell)) >= radius_m_ || cell == first_ || cell == last_;
}

bool ShortestWay::is_visible(Vec2 from, Vec2 to) const {
  return toolkit::for_each_cell_on_line(
      grid_, from, to, [&](toolkit::Cell cell) { return grid_.contains(cell) && open(grid_.index(cell)); });
}

Vec2 ShortestWay::position_of(std::uint32_t cell) const {
  if (cell == first_) return from_;
  if (cell == last_) return to_;
  return grid_.center(cell);
}

}  // namespace dmrp::metrics
