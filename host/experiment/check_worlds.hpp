// SPDX-License-Identifier: MIT
// check_worlds.hpp: whether the robots and people of a scenario can do what it asks of them.
#pragma once

#include <cstddef>
#include <optional>

#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

// Robots to be drawn in a scenario: how many at most, and where they are asked for.
struct DrawnRobots {
  std::size_t most = 0;
  std::optional<TomlValue> at{};  // there where most > 0
};

// Checks starts, goals and flows against the walls and the experiment's robot, and whether there is room for robots to
// be drawn in every repetition: an InputError at the place in the file, or a warning in the experiment.
void check_world(const ScenarioFile& file, Experiment& experiment, const DrawnRobots& drawn = {});

}  // namespace dmrp::host
