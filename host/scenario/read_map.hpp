// SPDX-License-Identifier: MIT
// read_map.hpp: reads maps in foreign formats into a scenario: [map] of scenario.toml, and [robots] for tasks on it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/cell_map.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

std::vector<TomlKey> map_keys();    // of [map]
std::vector<TomlKey> tasks_keys();  // of [robots]

// A MovingAI map; the coordinates of its tasks are its cells. Its lower left corner is that of the world.
struct TaskMap {
  core::CellMap cells;
  double cell_m = 1.0;
};

// Reads [map] into the scenario: its rectangle and its shapes. `file`, `shown_path`: of scenario.toml. Returns the map
// for tasks; none without [map], or for a map of map_server, which has no tasks.
std::optional<TaskMap> read_map(const TomlTable& root, const std::filesystem::path& file, const std::string& shown_path,
                                ScenarioFile& out);

// Reads [robots]: tasks of a .scen file.
void read_tasks(const TomlTable& table, const std::optional<TaskMap>& map, const std::filesystem::path& file,
                const std::string& shown_path, ScenarioFile& out);

}  // namespace dmrp::host
