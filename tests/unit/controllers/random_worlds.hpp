// SPDX-License-Identifier: MIT
// random_worlds.hpp: every controller through its C interface in worlds, on paths, with limits, footprints and control
// periods that nobody chose, judged by what the contract asks at every step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

struct RandomDrive {
  std::vector<dmrp_command> commands;  // zero where there was no solution
  std::vector<std::string> breaches;   // of limits, accelerations, finiteness, status
};

// Drives `steps` control periods in the world that `seed` names. A seed always gives the same drive.
RandomDrive drive_at_random(PluginUnderTest& plugin, std::uint64_t seed, int steps);

}  // namespace dmrp::test
