// SPDX-License-Identifier: MIT
// guide.hpp: the shortest path over the free cells of the costmap. It starts an optimiser on a passable side of an
// obstacle, and shows whether a path exists at all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "controllers/motion/costmap_view.hpp"

namespace dmrp::controllers {

// Dijkstra's algorithm over the window's cells and their eight neighbours, with a bucket queue of integer costs. Reuses
// its buffers.
class Guide {
 public:
  void reserve(std::size_t cells_a_bucket) {
    for (std::vector<std::int32_t>& bucket : buckets_) bucket.reserve(cells_a_bucket);
  }

  // Searches from the robot over all cells with a clearance of at least `needed_m` about the centre; cells with less
  // than `easy_m` cost double. Close to the robot, which may already stand too close to an obstacle, any cell that is
  // not lethal is allowed.
  void spread(const CostmapView& map, Vec2 robot, double needed_m, double easy_m);

  // Whether a search with this clearance would reach a point. Sooner found than by spread(), whose result stays.
  bool connects(const CostmapView& map, Vec2 robot, Vec2 point, double needed_m);

  // Whether the search reached a point. After spread(), on the same map.
  bool reaches(const CostmapView& map, Vec2 point) const;

  // Points of the path from the robot to a point where reaches() holds, some decimetres apart.
  void path_to(const CostmapView& map, Vec2 point, std::vector<Vec2>& points) const;

 private:
  static constexpr std::int32_t unreached = 0x7FFFFFFF;
  static constexpr std::size_t bucket_count = 64;  // more than the most expensive step

  using Efforts = std::vector<std::uint8_t>;  // cost factor of a step onto a cell; 0: blocked

  static void read(const CostmapView& map, Vec2 robot, double needed_m, double easy_m, Efforts& efforts);

  Efforts efforts_;
  std::vector<std::int32_t> costs_;
  std::vector<std::int32_t> from_;  // the previous cell
  std::array<std::vector<std::int32_t>, bucket_count> buckets_;
  Efforts unfilled_;                  // of connects()
  std::vector<std::int32_t> filled_;  // of connects(): cells whose neighbours it has yet to look at
};

}  // namespace dmrp::controllers
