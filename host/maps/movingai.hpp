// SPDX-License-Identifier: MIT
// movingai.hpp: reads the formats of the MovingAI benchmarks: maps (.map) and tasks on them (.scen, version 1).
// Every mistake in a file is an InputError in one line, `file:line:column: what was expected`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/cell_map.hpp"

namespace dmrp::host {

// A cell in the files' coordinates: from the upper left, y downwards.
struct MovingAiCell {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  bool operator==(const MovingAiCell&) const = default;
};

struct MovingAiTask {
  MovingAiCell start;
  MovingAiCell goal;
  std::uint32_t line = 0;  // in the file
};

struct MovingAiTasks {
  std::string shown_path;
  std::string map_name;  // in the first task; empty if there is none
  std::vector<MovingAiTask> tasks;
};

// Free: '.', 'G' (ground) and 'S' (swamp, passable like ground). Blocked: '@' and 'O' (out of bounds), 'T' (trees) and
// 'W' (water, not passable from the ground). The last line of the file is row 0 of the map.
core::CellMap read_movingai_map(const std::filesystem::path& file, const std::string& shown_path);

// All tasks of the file; each starts and ends on a free cell of `map`.
MovingAiTasks read_movingai_tasks(const std::filesystem::path& file, const std::string& shown_path,
                                  const core::CellMap& map);

// The centre of a cell in the world frame, whose y points up; (0, 0) is the map's lower left corner.
dmrp_vec2 center_of(MovingAiCell cell, const core::CellMap& map, double cell_m);

}  // namespace dmrp::host
