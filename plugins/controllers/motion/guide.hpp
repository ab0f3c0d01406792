// SPDX-License-Identifier: MIT
// guide.hpp: the shortest way over the free cells of the costmap, for starting the optimiser on the right side of what
// stands in the way, and for knowing that there is no way.
#ifndef DMRP_CONTROLLERS_MOTION_GUIDE_HPP
#define DMRP_CONTROLLERS_MOTION_GUIDE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "controllers/motion/costmap_view.hpp"

namespace dmrp::controllers {

// Dijkstra's algorithm over the window's cells and their eight neighbours, with whole costs in buckets. Keeps its
// buffers.
class Guide {
 public:
  void reserve(std::size_t cells_a_bucket) {
    for (std::vector<std::int32_t>& bucket : buckets_) bucket.reserve(cells_a_bucket);
  }

  // From the robot to wherever it could stand with `needed_m` of clearance about its centre; a metre with less than
  // `easy_m` counts double. Very near the robot, where it may stand too close already, no more than not being on an
  // obstacle is asked.
  void spread(const CostmapView& map, dmrp_vec2 robot, double needed_m, double easy_m);

  // After spread(), on the same map.
  bool reaches(const CostmapView& map, dmrp_vec2 point) const;

  // Points of the way to where reaches() holds, from the robot on, some decimetres apart.
  void way_to(const CostmapView& map, dmrp_vec2 point, std::vector<dmrp_vec2>& points) const;

 private:
  static constexpr std::int32_t unreached = 0x7FFFFFFF;
  static constexpr std::size_t bucket_count = 64;  // more than the dearest step

  void read(const CostmapView& map, dmrp_vec2 robot, double needed_m, double easy_m);

  std::vector<std::uint8_t> efforts_;  // of a step onto a cell; 0: blocked
  std::vector<std::int32_t> costs_;
  std::vector<std::int32_t> from_;
  std::array<std::vector<std::int32_t>, bucket_count> buckets_;
};

}  // namespace dmrp::controllers

#endif
