// SPDX-License-Identifier: MIT
// read_shapes.hpp: reads [[box]], [[circle]] and [[polygon]] of scenario.toml.
#pragma once

#include <string>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline const std::vector<std::string> box_keys = {"name", "center_m", "size_m", "angle_rad", "height_m"};
inline const std::vector<std::string> circle_keys = {"name", "center_m", "radius_m", "height_m"};
inline const std::vector<std::string> polygon_keys = {"name", "vertices_m", "height_m"};

void read_shapes(const TomlTable& root, ScenarioFile& out);

}  // namespace dmrp::host
