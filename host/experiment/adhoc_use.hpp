// SPDX-License-Identifier: MIT
// adhoc_use.hpp: a scenario and a planner named on the command line, as an experiment of its own; parameters of a plugin
// that are given there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// An experiment of one scenario, named or given by its path; `to_plan`: checked against the default robot and grid.
// Throws InputError.
Experiment adhoc_experiment(const std::string& scenario, bool to_plan = true);

// Its scenario with `robots` drawn for the seed in place of those it lists. Throws InputError.
void use_random_tasks(Experiment& experiment, std::uint32_t robots, std::uint64_t seed);

// `id`: searched in `libraries`, then in those of the plugin path. `settings`: key=value, as TOML values; bare words
// are strings. Throws InputError.
void add_planner(Experiment& experiment, const std::string& id, const std::vector<std::string>& libraries,
                 const std::vector<std::string>& settings);

// `values`, complete, with those of a parameter file ("": none; from here, else a shipped one) and over them those of
// `settings` (as above) in their places. Throws InputError.
std::vector<ParameterValue> adhoc_parameters(const std::vector<std::string>& settings,
                                             const std::string& parameter_file, const PluginInfo& info,
                                             std::vector<ParameterValue> values);

}  // namespace dmrp::host
