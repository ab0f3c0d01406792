// SPDX-License-Identifier: MIT
// read_crowd.hpp: reads [people], [[region]] and [[flow]] of scenario.toml.
#pragma once

#include <string>
#include <vector>

#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline const std::vector<std::string> region_keys = {"name", "lower_m", "upper_m"};
inline const std::vector<std::string> flow_keys = {"name",   "from",  "via",     "to",
                                                   "people", "start", "respawn", "group_size"};
TomlKeys people_keys();

void read_crowd(const TomlTable& root, ScenarioFile& out);

}  // namespace dmrp::host
