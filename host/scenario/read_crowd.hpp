// SPDX-License-Identifier: MIT
// read_crowd.hpp: reads [people], [[region]] and [[flow]] of scenario.toml.
#pragma once

#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// The keys of [people], [[region]] and [[flow]].
TomlKeys people_keys();
std::vector<TomlKey> region_keys();
std::vector<TomlKey> flow_keys();

void read_crowd(const TomlTable& root, ScenarioFile& out);

}  // namespace dmrp::host
