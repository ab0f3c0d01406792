// SPDX-License-Identifier: MIT
// read_shapes.hpp: reads [[box]], [[circle]] and [[polygon]] of scenario.toml.
#pragma once

#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// The keys of [[box]], [[circle]] and [[polygon]].
std::vector<TomlKey> box_keys();
std::vector<TomlKey> circle_keys();
std::vector<TomlKey> polygon_keys();

void read_shapes(const TomlTable& root, ScenarioFile& out);

}  // namespace dmrp::host
