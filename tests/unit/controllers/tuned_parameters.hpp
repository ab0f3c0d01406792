// SPDX-License-Identifier: MIT
// tuned_parameters.hpp: the parameter sets that are shipped for the shared scenarios.
#pragma once

#include <string>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

// What the tuned set of a controller changes: of plugins/controllers/parameter_sets/tuned/dwa.toml for
// dmrp.controller.dwa. Empty where there is none. Throws std::runtime_error for what is no set.
ParamOverrides tuned_parameters(const std::string& controller);

}  // namespace dmrp::test
