// SPDX-License-Identifier: MIT
// find_scenario.hpp: finds scenarios by name or path.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dmrp::host {

// The folders that are searched for scenarios by name: the shipped ones, then those of DMRP_SCENARIO_PATH.
std::vector<std::filesystem::path> scenario_folders();

// Whether a scenario can be this file alone: a map of map_server or of MovingAI.
bool is_map_file(const std::filesystem::path& file);

// The scenario.toml, or map, for a name or a path relative to `base`; empty if there is none.
std::filesystem::path find_scenario(const std::string& name_or_path, const std::filesystem::path& base);

// "mall", "course/door"; empty for another file.
std::string name_of_shipped_scenario(const std::filesystem::path& file);

std::vector<std::string> shipped_scenarios();
std::vector<std::string> known_scenarios();  // the shipped ones and those of DMRP_SCENARIO_PATH

}  // namespace dmrp::host
