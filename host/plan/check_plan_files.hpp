// SPDX-License-Identifier: MIT
// check_plan_files.hpp: checks plans from files before the first trial, as those of planners are checked.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// Reads the plans of all trials and validates them. Throws InputError at the row of the first mistake of each use.
// The warnings, one line each, tell which tasks have no plan.
std::vector<std::string> check_plan_files(const Experiment& experiment);

}  // namespace dmrp::host
