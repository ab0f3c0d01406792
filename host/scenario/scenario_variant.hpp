// SPDX-License-Identifier: MIT
// scenario_variant.hpp: a scenario with a number of robots, as used by an experiment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/random_tasks.hpp"
#include "core/scene/robot_types.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::host {

// A scenario with a number of robots: either the first of the listed ones, or robots with random tasks for each trial.
struct ScenarioVariant {
  core::Scenario scenario;     // with exactly the listed robots that take part
  std::string label;           // the scenario's name; "mall/2" if the number of robots differs from the listed number
  std::filesystem::path file;  // scenario.toml
  std::vector<std::filesystem::path> files{};  // other files that it names: maps, tasks, recordings, tiles
  std::uint32_t drawn_robots = 0;              // robots with random tasks; then no listed robot takes part
  std::uint32_t most_drawn = 0;  // the largest drawn_robots of this [[scenario]]: people keep clear of all their starts
  std::uint32_t entry = 0;       // index of the [[scenario]]
  bool all_drawn = false;        // tasks = "drawn"
  core::RobotTypes types{};      // that its robots can have
  std::vector<core::TypeShare> drawn_types{};  // of the drawn robots; none: all of the default type
};

inline std::uint32_t robot_count(const ScenarioVariant& variant) {
  return variant.drawn_robots + static_cast<std::uint32_t>(variant.scenario.robots.size());
}

// The names of the types of its robots, each once.
std::vector<std::string> types_in_use(const ScenarioVariant& variant);

}  // namespace dmrp::host
