// SPDX-License-Identifier: MIT
// read_tiles.hpp: reads [tiles] of scenario.toml: a larger world made of copies of another.
#pragma once

#include <filesystem>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

std::vector<TomlKey> tiles_keys();

// Reads [tiles] into the scenario: its size, and for every tile the shapes, regions and flows of the named scenario, so
// that the number of people grows with the area. The robots and the borders of the tiles are not copied. `file`:
// scenario.toml.
void read_tiles(const TomlTable& root, const std::filesystem::path& file, ScenarioFile& out);

}  // namespace dmrp::host
