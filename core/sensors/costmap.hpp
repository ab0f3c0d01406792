// SPDX-License-Identifier: MIT
// costmap.hpp: a rolling window of obstacles around a robot, by marking and clearing, with inflation.
#pragma once

#include <dmrp/ext/distance_field.h>
#include <dmrp/ext/lidar.h>
#include <dmrp/ext/local_costmap.h>

#include <cstdint>
#include <dmrp/toolkit/distance_transform.hpp>
#include <vector>

#include "core/scene/settings.hpp"

namespace dmrp::core {

// Semantics of ROS costmap_2d: a scan first clears the cells along its beams, then marks the cells of its hits; cells
// that it does not observe keep their state while the window rolls. Cells are aligned with the world's lattice
// (multiples of the resolution from the world's origin), so that rolling moves whole cells. Unlike costmap_2d there is
// no footprint clearing: a body that touches the robot stays on the map.
//
// A beam without return clears up to the raytrace range, as with costmap_2d's inf_is_valid: otherwise a person who
// walks in front of an open hall would leave a trail. If the lidar has drop-outs, a beam without return is weaker
// evidence: it counts as a miss of the nearest lethal cell on its line only. A cell is cleared after n misses without a
// hit in between, where n drop-outs in a row have a probability below one in a million.
class LocalCostmap {
 public:
  // `dropout_share` is that of the lidar.
  LocalCostmap(const CostmapSettings& settings, double inscribed_radius_m, double dropout_share = 0.0);

  // costmap() and distance_field() point into the object.
  LocalCostmap(const LocalCostmap&) = delete;
  LocalCostmap& operator=(const LocalCostmap&) = delete;

  // Clears the map and its position.
  void reset();

  // Rolls the window to the sensor, clears, marks and inflates.
  void update(const dmrp_pose& sensor, const dmrp_scan& scan);

  // Valid until the next update. All free before the first.
  const dmrp_costmap& costmap() const { return costmap_; }

  // Distances to the obstacles of the last update, computed at the first call. Valid until the next update.
  const dmrp_field& distance_field();

 private:
  void make_stamp(double inscribed_radius_m);
  bool roll_to(dmrp_vec2 center);
  void aim_beams(const dmrp_pose& sensor, const dmrp_scan& scan);
  void count_miss_along(dmrp_vec2 from, dmrp_vec2 to);
  bool mark(dmrp_vec2 point);
  bool drop_free_cells();
  bool clear(dmrp_vec2 from, const dmrp_pose& sensor, const dmrp_scan& scan);
  bool is_cleared(std::int64_t column, std::int64_t row, dmrp_vec2 from, const dmrp_pose& sensor,
                  const dmrp_scan& scan) const;
  void inflate();

  CostmapSettings settings_;
  std::int64_t side_;        // cells
  std::int64_t column_ = 0;  // lattice position of the lower left cell
  std::int64_t row_ = 0;
  bool is_placed_ = false;
  std::uint8_t misses_to_clear_;      // beams without return that clear a cell after a hit
  std::vector<std::uint8_t> lethal_;  // for each cell the misses that still clear it; 0: free
  std::vector<std::uint32_t> cells_;  // the lethal cells, by index
  std::vector<std::uint8_t> misses_;  // of cells_, while they roll
  std::vector<std::uint8_t> scans_;   // for each cell the last scan that marked it; 0: none of the last 255
  std::uint8_t scan_ = 0;

  // Directions of the beams in the sensor's frame, for scans with these angles, and in cells per metre for this scan.
  double angle_min_ = 0.0;
  double angle_increment_ = 0.0;
  std::vector<dmrp_vec2> directions_;
  std::vector<dmrp_vec2> cells_per_metre_;

  // The costs that one lethal cell gives to the square around it.
  std::int64_t stamp_reach_ = 0;   // cells from the middle
  std::int64_t stamp_stride_ = 0;  // of a row, padded with zeros
  std::vector<std::uint8_t> stamp_;
  std::vector<std::uint8_t> canvas_;  // the window with a border for stamps at its edges
  std::vector<std::uint8_t> costs_;
  dmrp_costmap costmap_{};

  toolkit::DistanceTransform transform_;
  bool field_is_fresh_ = false;
  dmrp_field field_{};
};

}  // namespace dmrp::core
