// SPDX-License-Identifier: MIT
// adhoc_use.hpp: experiments from the command line: a scenario, a planner, and parameters of a plugin.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// An experiment with one scenario, given by its name or path. `to_plan`: checks it against the default robot and grid.
// Throws InputError.
Experiment adhoc_experiment(const std::string& scenario, bool to_plan = true);

// Replaces the listed robots of its scenario by `robots` robots with random tasks for the seed. Throws InputError.
void use_random_tasks(Experiment& experiment, std::uint32_t robots, std::uint64_t seed,
                      const core::TaskWishes& wishes = {});

// Searches the planner `id` in `libraries`, then in the libraries of the plugin path. `settings`: key=value with TOML
// values; bare words are strings. Throws InputError.
void add_planner(Experiment& experiment, const std::string& id, const std::vector<std::string>& libraries,
                 const std::vector<std::string>& settings, const PluginSource& source);

// The complete table `values`, overridden by a parameter file ("": none; relative to the working directory, or a
// shipped one) and then by `settings` (as above). Throws InputError.
std::vector<ParameterValue> adhoc_parameters(const std::vector<std::string>& settings,
                                             const std::string& parameter_file, const PluginInfo& info,
                                             std::vector<ParameterValue> values);

}  // namespace dmrp::host
