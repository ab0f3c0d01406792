// SPDX-License-Identifier: MIT
// ros_map.hpp: reads maps of ROS's map_server: a YAML file that names an image and defines the meaning of its shades.
// Every mistake in a file is an InputError in one line, `file:line:column: what was expected`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "core/scene/cell_map.hpp"

namespace dmrp::host {

// The treatment of cells that are unknown in the map.
enum class UnknownCells { occupied, free };

struct RosMap {
  core::CellMap cells;
  double resolution_m = 0.0;
  dmrp_pose origin{};               // lower left corner of the map in the world frame; theta: the direction of the rows
  std::filesystem::path image;      // absolute if `file` is
  std::size_t unknown = 0;          // cells
  std::size_t unknown_as_free = 0;  // of the grey by which map_saver writes unknown cells, but free by free_thresh
  double free_thresh = 0.0;
};

// Interprets shades like nav2's map_server. Mode `trinary` (the default): occupied, free or unknown cells. Modes
// `scale` and `raw`: occupancy probabilities of 0 to 100; a cell is blocked from 50 on; a cell that is not opaque
// (scale) or above 100 (raw) is unknown.
//
// `unknown`: as the user asked; none: occupied. In trinary mode, map_saver writes unknown cells as grey 205 beside
// thresholds by which some versions read it as free: if the user asked, grey 205 is unknown whatever free_thresh.
RosMap read_ros_map(const std::filesystem::path& file, const std::string& shown_path,
                    std::optional<UnknownCells> unknown);

}  // namespace dmrp::host
