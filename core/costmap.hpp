// SPDX-License-Identifier: MIT
// costmap.hpp: a rolling window of obstacles about a robot, by marking and clearing, with inflation.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>

#include <cstdint>
#include <vector>

#include "core/settings.hpp"

namespace dmrp::core {

// Semantics of ROS costmap_2d: a scan first clears the cells along its beams, then marks the cells of its hits; what it
// does not see stays as it was while the window rolls on. Cells lie on the world's lattice (multiples of the resolution
// from the world's zero), so that rolling moves whole cells.
class LocalCostmap {
 public:
  LocalCostmap(const CostmapSettings& settings, double inscribed_radius_m);

  // Forgets everything.
  void reset();

  // Rolls the window to the sensor, clears, marks, inflates.
  void update(const dmrp_pose& sensor, const dmrp_scan& scan);

  // Valid until the next update.
  const dmrp_costmap& costmap() const { return costmap_; }

  // Derived when first asked for after an update. Valid until the next update.
  const dmrp_field& distance_field();

 private:
  void roll_to(dmrp_vec2 center);
  void clear_along(const dmrp_pose& sensor, const dmrp_scan& scan);
  void mark_hits(const dmrp_pose& sensor, const dmrp_scan& scan);
  void measure_distances();
  void inflate();

  CostmapSettings settings_;
  std::uint32_t side_ = 0;   // cells
  std::int64_t column_ = 0;  // lattice position of the lower left cell
  std::int64_t row_ = 0;
  std::vector<std::uint8_t> lethal_;
  std::vector<std::uint8_t> costs_;
  std::vector<float> distances_m_;
  std::vector<std::uint8_t> cost_of_squared_distance_;  // by squared distance in cells
  bool distances_are_fresh_ = false;
  dmrp_costmap costmap_{};
  dmrp_field field_{};
};

}  // namespace dmrp::core
