// SPDX-License-Identifier: MIT
// Neighbour search: a uniform grid of cells, filled again at every step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace dmrp::pedestrians {

// A person or a robot, as its neighbours see it.
struct Body {
  Vec2 position;
  Vec2 velocity;
  double radius_m;
  std::uint32_t slot;  // of a person; no_slot for a robot
};

inline constexpr std::uint32_t no_slot = 0xFFFFFFFFu;

// A body found near a point.
struct NearBody {
  double squared_distance;
  const Body* body;
};

struct NearBodies {
  const NearBody* first;
  const NearBody* last;
  const NearBody* begin() const { return first; }
  const NearBody* end() const { return last; }
};

// The grid covers the world, not the crowd, and the bodies of a cell keep their order. So the neighbours of a person do
// not depend on people far away. Bodies outside the world belong to the cells at its border.
class NeighborGrid {
 public:
  // The result is the same for any size of cells; the fastest is a fraction of the search radius.
  void start(Vec2 lower, Vec2 upper, double cell_m);

  // Fills the cells by counting sort. Allocates only if there are more bodies than in all builds before.
  void build(const std::vector<Body>& bodies);

  // All bodies within `reach_m` of the point, one at the point itself included. Their order depends on bodies near the
  // point only. Valid until the next call of near() or build().
  NearBodies near(Vec2 point, double reach_m) {
    const std::int32_t first_column = column_of(point.x - reach_m);
    const std::int32_t last_column = column_of(point.x + reach_m);
    const std::int32_t last_row = row_of(point.y + reach_m);
    const double squared_reach = reach_m * reach_m;
    NearBody* free = found_.data();
    for (std::int32_t row = row_of(point.y - reach_m); row <= last_row; ++row) {
      // the cells of a row are adjacent, so their bodies form one run
      const std::uint32_t end = begins_[cell(last_column, row) + 1];
      for (std::uint32_t i = begins_[cell(first_column, row)]; i < end; ++i) {
        // without a branch: every body is written, and the next one overwrites it if it is too far
        *free = {toolkit::squared_distance(point, positions_[i]), &sorted_[i]};
        free += free->squared_distance <= squared_reach ? 1 : 0;
      }
    }
    return {found_.data(), free};
  }

  // The bodies by cell, row by row. In this order, the neighbours of successive people are in the cache.
  const std::vector<Body>& by_place() const { return sorted_; }

 private:
  std::size_t cell(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }
  std::int32_t column_of(double x) const { return clamped((x - lower_.x) * cells_per_m_, columns_); }
  std::int32_t row_of(double y) const { return clamped((y - lower_.y) * cells_per_m_, rows_); }
  static std::int32_t clamped(double cells, std::int32_t count) {
    return cells > 0.0 ? static_cast<std::int32_t>(std::min(cells, count - 1.0)) : 0;
  }

  Vec2 lower_ = {0.0, 0.0};
  double cells_per_m_ = 1.0;
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<std::uint32_t> begins_;  // of every cell in sorted_, and the end
  std::vector<std::uint32_t> cell_of_body_;
  std::vector<Body> sorted_;
  std::vector<Vec2> positions_;  // of sorted_
  std::vector<NearBody> found_;  // has one entry more than there are bodies
};

}  // namespace dmrp::pedestrians
