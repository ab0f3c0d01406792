// SPDX-License-Identifier: MIT
// check_worlds.hpp: whether the robots and people of a scenario can do what it asks of them.
#pragma once

#include "host/experiment/experiment.hpp"
#include "host/experiment/read_scenario.hpp"

namespace dmrp::host {

// Checks starts, goals and flows against the walls and the experiment's robot: an InputError at the place in the
// scenario file, or a warning in the experiment.
void check_world(const ScenarioFile& file, Experiment& experiment);

}  // namespace dmrp::host
