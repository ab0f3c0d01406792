// SPDX-License-Identifier: MIT
#include "controllers/e3mop/goal_distances.hpp"

#include <cmath>

namespace dmrp::controllers::e3mop {

namespace {

// More cells than one bucket held in any window observed. Buckets are swapped, so each of them reserves this.
constexpr std::size_t bucket_reserve = 2048;

}  // namespace

void GoalDistances::reserve(const LatticeFrame& frame) {
  labels_.reserve(static_cast<std::size_t>(frame.cell_count()));
  exits_.reserve(static_cast<std::size_t>(frame.cell_count()));
  for (std::vector<std::int32_t>& bucket : buckets_) bucket.reserve(bucket_reserve);
  settling_.reserve(bucket_reserve);
}

void GoalDistances::begin(const LatticeFrame& frame, const std::vector<std::uint8_t>& free) {
  free_ = &free;
  const auto cells = static_cast<std::size_t>(frame.cell_count());
  labels_.assign(cells, infinite);
  exits_.assign(cells, -1);
  for (std::vector<std::int32_t>& bucket : buckets_) bucket.clear();
  queued_ = 0;
  settled_below_ = 0;
  for (std::size_t k = 0; k < direction_count; ++k) {
    const Direction& along = directions()[k];
    back_[k] = -(along.dy * frame.stride() + along.dx);
    // rounded down: the heuristic must not exceed the true cost
    edge_[k] = static_cast<std::int32_t>(std::floor(unit * std::hypot(along.dx, along.dy)));
  }
}

void GoalDistances::seed(std::int32_t cell) {
  if ((*free_)[static_cast<std::size_t>(cell)]) relax(cell, 0, -1);
}

void GoalDistances::relax(std::int32_t cell, std::int32_t label, std::int32_t exit) {
  const auto c = static_cast<std::size_t>(cell);
  if (label >= labels_[c]) return;
  labels_[c] = label;
  exits_[c] = static_cast<std::int8_t>(exit);
  buckets_[static_cast<std::size_t>(label / unit) % bucket_count].push_back(cell);
  ++queued_;
}

void GoalDistances::settle_bucket() {
  const std::int32_t lowest = settled_below_;
  settled_below_ += unit;
  settling_.swap(buckets_[static_cast<std::size_t>(lowest / unit) % bucket_count]);
  queued_ -= settling_.size();
  for (const std::int32_t cell : settling_) {
    const auto c = static_cast<std::size_t>(cell);
    const std::int32_t label = labels_[c];
    if (label < lowest) continue;  // reached by a shorter path since
    for (std::size_t k = 0; k < direction_count; ++k) {
      const std::int32_t from = cell + back_[k];
      if ((*free_)[static_cast<std::size_t>(from)]) relax(from, label + edge_[k], static_cast<std::int32_t>(k));
    }
  }
  settling_.clear();
}

}  // namespace dmrp::controllers::e3mop
