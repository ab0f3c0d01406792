// SPDX-License-Identifier: MIT
// random_worlds.hpp: drives a controller through its C interface with random worlds, paths, limits, footprints and
// control periods, and checks the contract at every step.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/plugin_under_test.hpp"

namespace dmrp::test {

struct RandomDrive {
  std::vector<dmrp_command> commands;  // zero if there was no solution
  std::vector<std::string> breaches;   // of limits, accelerations, finiteness, status
};

// Drives `steps` control periods in a world drawn from `seed`. Equal seeds give equal drives.
RandomDrive drive_at_random(PluginUnderTest& plugin, std::uint64_t seed, int steps);

}  // namespace dmrp::test
