// SPDX-License-Identifier: MIT
// ros_map.hpp: reads maps of ROS's map_server: a YAML file that names an image and defines the meaning of its shades.
// Every mistake in a file is an InputError in one line, `file:line:column: what was expected`.
#pragma once

#include <filesystem>
#include <string>

#include "core/scene/cell_map.hpp"

namespace dmrp::host {

// The treatment of cells that are unknown in the map.
enum class UnknownCells { occupied, free };

struct RosMap {
  core::CellMap cells;
  double resolution_m = 0.0;
  dmrp_pose origin{};           // lower left corner of the map in the world frame; theta: the direction of the rows
  std::filesystem::path image;  // absolute if `file` is
};

// Interprets shades like nav2's map_server. Mode `trinary` (the default): occupied, free or unknown cells. Modes
// `scale` and `raw`: occupancy probabilities of 0 to 100; a cell is blocked from 50 on; a cell that is not opaque
// (scale) or above 100 (raw) is unknown.
RosMap read_ros_map(const std::filesystem::path& file, const std::string& shown_path, UnknownCells unknown);

}  // namespace dmrp::host
