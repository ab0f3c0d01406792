// SPDX-License-Identifier: MIT
// check_regions.hpp: whether planning cells cut off rooms that robots could reach, and which cells would not.
#pragma once

#include <array>
#include <vector>

#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

inline constexpr std::array proposed_cells_m = {1.0, 0.75, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1};
inline constexpr double most_cells_tried = 1e6;  // of a grid that a message proposes

// A scenario of an experiment, with the robots that tasks are drawn for.
struct WorldUse {
  ScenarioFile file;
  core::RobotTypes types;
  RandomRobots drawn;
};

// How many regions (core/tasks/free_regions.hpp) the cells of each scenario with drawn tasks cut off from them, and which
// cells reach all of all scenarios.
CutOff find_cut_off(const std::vector<WorldUse>& worlds, const core::SimulationSettings& settings);

// The largest of the proposed cells with which listed robots reach their goals and drawn ones all regions, in all
// scenarios. 0 if there are none.
double cells_for_all(const std::vector<WorldUse>& worlds, const core::SimulationSettings& settings);

}  // namespace dmrp::host
