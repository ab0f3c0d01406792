// SPDX-License-Identifier: MIT
// adhoc_use.hpp: a scenario and a planner named on the command line, as an experiment of its own.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// `scenario`: a name or a path. `planner`: an id, searched in `libraries` and those of the plugin path; none if empty.
// `settings`: key=value for the planner, as TOML values; bare words are strings. Throws InputError.
Experiment adhoc_experiment(const std::string& scenario, const std::string& planner,
                            const std::vector<std::string>& libraries, const std::vector<std::string>& settings);

}  // namespace dmrp::host
