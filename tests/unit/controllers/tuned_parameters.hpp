// SPDX-License-Identifier: MIT
// tuned_parameters.hpp: the shipped parameter sets for the shared scenarios.
#pragma once

#include <string>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

// The parameters in the tuned set of a controller: plugins/controllers/parameter_sets/tuned/dwa.toml for
// dmrp.controller.dwa. Empty if there is no such file. Throws std::runtime_error if the file is not a parameter set.
ParamOverrides tuned_parameters(const std::string& controller);

}  // namespace dmrp::test
