// SPDX-License-Identifier: MIT
// costmap.hpp: a rolling window of obstacles about a robot, by marking and clearing, with inflation.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>

#include <cstdint>
#include <dmrp/toolkit/distance_transform.hpp>
#include <vector>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// Semantics of ROS costmap_2d: a scan first clears the cells along its beams, then marks the cells of its hits; what it
// does not see stays as it was while the window rolls on. Cells lie on the world's lattice (multiples of the resolution
// from the world's zero), so that rolling moves whole cells. Nothing is cleared for being under the robot (costmap_2d's
// footprint clearing): whoever touches the robot stays on the map.
//
// A beam without return clears up to the raytrace range, as with costmap_2d's inf_is_valid: else who walks on before
// an open hall would leave a trail. Of a lidar that drops beams out it says less: only the nearest lethal cell on its
// way is in doubt, and is cleared by as many such beams, with no hit in between, as drop out in a row in less than one
// of a million cases.
class LocalCostmap {
 public:
  // `dropout_share` is that of the lidar.
  LocalCostmap(const CostmapSettings& settings, double inscribed_radius_m, double dropout_share = 0.0);

  // Its structs point into it.
  LocalCostmap(const LocalCostmap&) = delete;
  LocalCostmap& operator=(const LocalCostmap&) = delete;

  // Forgets everything.
  void reset();

  // Rolls the window to the sensor, clears, marks, inflates.
  void update(const dmrp_pose& sensor, const dmrp_scan& scan);

  // Valid until the next update. All free before the first.
  const dmrp_costmap& costmap() const { return costmap_; }

  // Distances to the obstacles of the last update, derived when first asked for. Valid until the next update.
  const dmrp_field& distance_field();

 private:
  void make_stamp(double inscribed_radius_m);
  void roll_to(dmrp_vec2 center);
  void aim_beams(const dmrp_pose& sensor, const dmrp_scan& scan);
  void clear_along(dmrp_vec2 from, dmrp_vec2 to);
  void doubt_along(dmrp_vec2 from, dmrp_vec2 to);
  void mark(dmrp_vec2 point);
  void inflate();

  CostmapSettings settings_;
  std::int64_t side_;        // cells
  std::int64_t column_ = 0;  // lattice position of the lower left cell
  std::int64_t row_ = 0;
  bool is_placed_ = false;
  std::uint8_t full_trust_;           // beams without return that it takes to clear a cell that was just hit
  std::vector<std::uint8_t> lethal_;  // as many as it still takes; 0: free
  std::vector<std::uint8_t> rolled_;

  // Of the beams: in the sensor's frame, for scans of this make; and of this scan, in cells a metre.
  double angle_min_ = 0.0;
  double angle_increment_ = 0.0;
  std::vector<dmrp_vec2> directions_;
  std::vector<dmrp_vec2> cells_per_metre_;

  // The costs that one lethal cell gives to the square about it.
  std::int64_t stamp_reach_ = 0;   // cells from its middle
  std::int64_t stamp_stride_ = 0;  // a row, padded with zeros
  std::vector<std::uint8_t> stamp_;
  std::vector<std::uint8_t> canvas_;  // the window with room for stamps at its edges
  std::vector<std::uint8_t> costs_;
  dmrp_costmap costmap_{};

  toolkit::DistanceTransform transform_;
  bool field_is_fresh_ = false;
  dmrp_field field_{};
};

}  // namespace dmrp::core
