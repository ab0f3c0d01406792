// SPDX-License-Identifier: MIT
// check_planners.hpp: asks the planners of an experiment whether they can plan for robots that differ in shape or are
// larger than a cell allows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// For each scenario with such robots: a planner that finds no solution for the first plan although it has no time to
// search refuses, and its line is an InputError at its place in the file. `shown_file`: the experiment file in messages.
// Other experiments start no planner.
void check_planners(const Experiment& experiment, const std::filesystem::path& shown_file);

// What experiment.cut_off finds, a line each, with one advice for all scenarios, robots and planners: the cells that reach
// everything, and the planners that refuse them. Without such lines it starts no planner.
std::vector<std::string> cut_off_warnings(const Experiment& experiment);

}  // namespace dmrp::host
