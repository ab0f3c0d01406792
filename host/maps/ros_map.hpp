// SPDX-License-Identifier: MIT
// ros_map.hpp: maps of ROS's map_server: a YAML file that names an image and says what its shades mean.
// Every mistake in a file is an InputError in one line, `file:line:column: what was expected`.
#pragma once

#include <filesystem>
#include <string>

#include "core/scene/cell_map.hpp"

namespace dmrp::host {

// What becomes of cells that the map does not know.
enum class UnknownCells { occupied, free };

struct RosMap {
  core::CellMap cells;
  double resolution_m = 0.0;
  dmrp_pose origin{};           // of the lower left cell's lower left corner, in the world frame; theta: the rows' way
  std::filesystem::path image;  // absolute where `file` is
};

// Shades as nav2's map_server reads them. `trinary` (the default) knows occupied, free and unknown cells. `scale` and
// `raw` give chances of 0 to 100 in between: a cell stands here from 50 on; one that is not opaque (scale) or above 100
// (raw) is unknown.
RosMap read_ros_map(const std::filesystem::path& file, const std::string& shown_path, UnknownCells unknown);

}  // namespace dmrp::host
