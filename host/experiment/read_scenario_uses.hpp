// SPDX-License-Identifier: MIT
// read_scenario_uses.hpp: the tables [[scenario]] of an experiment file.
#pragma once

#include <optional>
#include <vector>

#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

std::vector<TomlKey> scenario_use_keys();  // of [[scenario]]

// A [[scenario]] with its scenario file.
struct ScenarioUse {
  TomlValue use;      // the value of its key `use`
  ScenarioFile file;  // with the listed robots of its largest variant alone
  RandomRobots random;
  std::optional<TomlValue> types{};  // the value of its key `types`: shares of drawn robots
  StartJitter jitter{};
  PeopleChange people{};
  core::RobotTypes robot_types{};  // after resolve_robot_types()
};

// Reads all [[scenario]] into `uses`, also those beside one with a mistake; adds a variant to the experiment for each
// number of robots. Throws InputError.
void read_scenario_uses(const TomlTable& root, Experiment& experiment, std::vector<ScenarioUse>& uses);

// Sets the types of robot of a [[scenario]] and of its variants; `entry`: its position among them. The experiment's own types must
// have been read. Throws InputError.
void resolve_robot_types(ScenarioUse& use, std::size_t entry, Experiment& experiment);

}  // namespace dmrp::host
