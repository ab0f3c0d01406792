// SPDX-License-Identifier: MIT
// environment.hpp: the environment variables of processes that run plugins. They have these alone, because values must not
// depend on who starts a run.
#pragma once

#include <string>
#include <vector>

namespace dmrp::host {

// Those of this process that plugins have, too, as "NAME=VALUE", sorted: what libraries for threads and interpreters read, and
// DMRP_TEST_*, for tests of plugins. They are part of a run's identity.
std::vector<std::string> passed_environment();

// Leaves this process the variables above, and gives it fixed values of PATH, LANG, HOME and TMPDIR. `scratch` is the folder
// for temporary files.
void reduce_environment(const std::string& scratch);

}  // namespace dmrp::host
