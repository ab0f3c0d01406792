// SPDX-License-Identifier: MIT
// scenario_variant.hpp: a scenario with a number of robots, as an experiment runs it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scenario.hpp"

namespace dmrp::host {

// A scenario with a number of robots: the first of those that it lists, or as many drawn for each trial.
struct ScenarioVariant {
  core::Scenario scenario;     // holds exactly the listed robots that take part
  std::string label;           // the scenario's name; "mall/2" where it runs with another number than it lists
  std::filesystem::path file;  // of scenario.toml
  std::vector<std::filesystem::path> files{};  // that it names: a map, tasks
  std::uint32_t drawn_robots = 0;              // none of the listed ones takes part then
  std::uint32_t most_drawn = 0;  // by the variants of one [[scenario]]: people keep clear of all their starts
  std::uint32_t entry = 0;       // the [[scenario]] that it comes from
  bool all_drawn = false;        // tasks = "drawn"
};

inline std::uint32_t robot_count(const ScenarioVariant& variant) {
  return variant.drawn_robots + static_cast<std::uint32_t>(variant.scenario.robots.size());
}

}  // namespace dmrp::host
