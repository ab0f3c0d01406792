// SPDX-License-Identifier: MIT
// Who is near whom: bodies sorted into the cells of a uniform grid, anew at every step.
#pragma once

#include <dmrp/values.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dmrp::pedestrians {

// Somebody who is given way to: a person or a robot.
struct Body {
  dmrp_vec2 position;
  dmrp_vec2 velocity;
  double radius_m;
  double weight;       // how much others mind this body: 1 for a person, the awareness of robots for a robot
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

// The grid is laid over the world, not over the crowd, and bodies of a cell keep their order, so that what one person
// sees does not depend on people far away. Bodies outside the world count to the cells at its border.
class NeighborGrid {
 public:
  // Cells of this size; the result is the same for any, the best is a fraction of what is looked through.
  void start(dmrp_vec2 lower, dmrp_vec2 upper, double cell_m);

  // Sorts the bodies in by counting. Allocates only where there are more bodies than ever before.
  void build(const std::vector<Body>& bodies);

  // All bodies within `reach_m` of the point, in an order that only the bodies near it decide; a body at the point
  // itself is one of them. Valid until the next call of near() or build().
  NearBodies near(dmrp_vec2 point, double reach_m) {
    const std::int32_t first_column = column_of(point.x - reach_m);
    const std::int32_t last_column = column_of(point.x + reach_m);
    const std::int32_t last_row = row_of(point.y + reach_m);
    const double squared_reach = reach_m * reach_m;
    NearBody* free = found_.data();
    for (std::int32_t row = row_of(point.y - reach_m); row <= last_row; ++row) {
      // the cells of a row follow each other, so its bodies are one run
      const std::uint32_t end = begins_[cell(last_column, row) + 1];
      for (std::uint32_t i = begins_[cell(first_column, row)]; i < end; ++i) {
        const double dx = positions_[i].x - point.x;
        const double dy = positions_[i].y - point.y;
        // always written, but the next one takes its place where it is too far: no jump to predict
        *free = {dx * dx + dy * dy, &sorted_[i]};
        free += free->squared_distance <= squared_reach ? 1 : 0;
      }
    }
    return {found_.data(), free};
  }

  // The bodies by cell, row by row: who works through people in this order finds their neighbours in the cache.
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

  dmrp_vec2 lower_ = {0.0, 0.0};
  double cells_per_m_ = 1.0;
  std::int32_t columns_ = 1;
  std::int32_t rows_ = 1;
  std::vector<std::uint32_t> begins_;  // of every cell in sorted_, and the end
  std::vector<std::uint32_t> cell_of_body_;
  std::vector<Body> sorted_;
  std::vector<dmrp_vec2> positions_;  // of sorted_
  std::vector<NearBody> found_;       // room for all, and one more
};

}  // namespace dmrp::pedestrians
