// SPDX-License-Identifier: MIT
// goal_distances.hpp: the heuristic h2D of the search: the shortest distance from each cell to the goal over a
// 16-connected grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "controllers/e3mop/lattice.hpp"
#include "controllers/e3mop/lattice_frame.hpp"

namespace dmrp::controllers::e3mop {

// Dijkstra's algorithm backward from the goal, evaluated lazily: a query settles the cell and all cells closer to the
// goal.
//
// Buckets are as wide as the shortest edge, so that all cells of the lowest bucket are final in any order (Denardo and
// Fox, 1979).
class GoalDistances {
 public:
  static constexpr std::int32_t infinite = INT32_MAX;

  // Lengths are in thousandths of a cell's side.
  static constexpr std::int32_t unit = 1000;

  // Allocates for frames up to this size.
  void reserve(const LatticeFrame& frame);

  // `free` holds one flag per cell of the frame, 0 on the border; it must outlive the queries.
  void begin(const LatticeFrame& frame, const std::vector<std::uint8_t>& free);

  // Adds a cell of the goal, with distance 0; no effect if it is not free. Seeds come before the first query.
  void seed(std::int32_t cell);

  // `infinite` if no path leads to the goal.
  std::int32_t distance(std::int32_t cell) {
    const auto c = static_cast<std::size_t>(cell);
    while (!(labels_[c] < settled_below_) && queued_ > 0) settle_bucket();
    return labels_[c];
  }

  // The direction in which the shortest path leaves a cell whose distance was queried; -1 at the goal itself.
  std::int32_t exit_direction(std::int32_t cell) const { return exits_[static_cast<std::size_t>(cell)]; }

 private:
  static constexpr std::size_t bucket_count = 4;  // the longest edge spans three

  void settle_bucket();
  void relax(std::int32_t cell, std::int32_t label, std::int32_t exit);

  const std::vector<std::uint8_t>* free_ = nullptr;
  std::vector<std::int32_t> labels_;
  std::vector<std::int8_t> exits_;
  std::array<std::vector<std::int32_t>, bucket_count> buckets_;
  std::vector<std::int32_t> settling_;
  std::array<std::int32_t, direction_count> back_{};  // index offset of the neighbour against each direction
  std::array<std::int32_t, direction_count> edge_{};
  std::size_t queued_ = 0;
  std::int32_t settled_below_ = 0;
};

}  // namespace dmrp::controllers::e3mop
