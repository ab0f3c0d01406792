// SPDX-License-Identifier: MIT
// read_tiles.hpp: [tiles] of scenario.toml: a larger world of copies of another.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline const std::vector<std::string> tiles_keys = {"of", "columns", "rows"};

// Reads [tiles] into the scenario: its size, and in every tile the shapes, regions and flows of the scenario that it
// names, so that people grow with the area; neither its robots nor the border between tiles. `file`: scenario.toml.
void read_tiles(const TomlTable& root, const std::filesystem::path& file, ScenarioFile& out);

}  // namespace dmrp::host
