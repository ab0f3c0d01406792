// SPDX-License-Identifier: MIT
// read_scenario_uses.hpp: the tables [[scenario]] of an experiment file.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/check_worlds.hpp"
#include "host/experiment/experiment.hpp"
#include "host/scenario/read_scenario.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

inline const std::vector<std::string> scenario_use_keys = {"use", "robots", "tasks"};  // of [[scenario]]

// A [[scenario]] with its scenario file.
struct ScenarioUse {
  TomlValue use;      // the value of its key `use`
  ScenarioFile file;  // with the listed robots of its largest variant alone
  RandomRobots random;
};

// Reads all [[scenario]]; adds a variant to the experiment for each number of robots. Throws InputError.
std::vector<ScenarioUse> read_scenario_uses(const TomlTable& root, Experiment& experiment);

}  // namespace dmrp::host
