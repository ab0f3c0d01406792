// SPDX-License-Identifier: MIT
// goal_distances.hpp: the search's heuristic h2D: the way from every cell to the goal over a 16-connected grid.
#ifndef DMRP_CONTROLLERS_E3MOP_GOAL_DISTANCES_HPP
#define DMRP_CONTROLLERS_E3MOP_GOAL_DISTANCES_HPP

#include <array>
#include <cstdint>
#include <vector>

#include "controllers/e3mop/lattice.hpp"
#include "controllers/e3mop/lattice_frame.hpp"

namespace dmrp::controllers::e3mop {

// Dijkstra backward from the goal. Runs as far as it is asked: a cell's distance settles it and all nearer ones.
//
// Buckets are as wide as the shortest edge, so that all cells of the lowest one are final whatever their order (Denardo
// and Fox, 1979).
class GoalDistances {
 public:
  static constexpr std::int32_t infinite = INT32_MAX;

  // Lengths are in thousandths of a cell.
  static constexpr std::int32_t unit = 1000;

  // Makes room for frames up to this one.
  void reserve(const LatticeFrame& frame);

  // `free` holds a flag a cell of the frame, the border's 0; it must live as long as it is asked.
  void begin(const LatticeFrame& frame, const std::vector<std::uint8_t>& free);

  // A cell of the goal: distance 0. Nothing where it is not free. All seeds before the first question.
  void seed(std::int32_t cell);

  // Infinite where no way leads to the goal.
  std::int32_t distance(std::int32_t cell) {
    const auto c = static_cast<std::size_t>(cell);
    while (!(labels_[c] < settled_below_) && queued_ > 0) settle_bucket();
    return labels_[c];
  }

  // The direction in which the way leaves a cell whose distance was asked; -1 at the goal itself.
  std::int32_t way_out(std::int32_t cell) const { return way_out_[static_cast<std::size_t>(cell)]; }

 private:
  static constexpr std::size_t bucket_count = 4;  // the longest edge spans three

  void settle_bucket();
  void relax(std::int32_t cell, std::int32_t label, std::int32_t way_out);

  const std::vector<std::uint8_t>* free_ = nullptr;
  std::vector<std::int32_t> labels_;
  std::vector<std::int8_t> way_out_;
  std::array<std::vector<std::int32_t>, bucket_count> buckets_;
  std::vector<std::int32_t> settling_;
  std::array<std::int32_t, direction_count> back_{};  // from a cell to the one that lies against a direction
  std::array<std::int32_t, direction_count> edge_{};
  std::size_t queued_ = 0;
  std::int32_t settled_below_ = 0;
};

}  // namespace dmrp::controllers::e3mop

#endif
