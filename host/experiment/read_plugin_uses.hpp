// SPDX-License-Identifier: MIT
// read_plugin_uses.hpp: the tables [[global_planner]], [[local_controller]], [[pedestrian_model]] and [[metric]] of an
// experiment file.
#pragma once

#include <cstdint>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// The keys of the tables of one kind.
std::vector<TomlKey> plugin_use_keys(std::uint32_t kind);

// Returns the value by which the table names the plugin, or the file of plans, of this use; none: the table is of another
// use.
std::optional<TomlValue> naming(const TomlTable& table, const PluginUse& use);

// Reads all tables of one kind (DMRP_KIND_*) into `uses`, a list of the experiment: one use for each variant of a sweep.
// `all_libraries`: every library has been read; if not, plugins that are in none of them are passed over. If one was left
// out, so are they. Throws InputError.
void read_plugin_uses(const TomlTable& root, std::uint32_t kind, bool all_libraries, Experiment& experiment,
                      std::vector<PluginUse>& uses);

// The planners that [simulation] of any scenario names as replan_fallback. Call it when the settings are known.
void read_fallback_planners(const TomlTable& root, bool all_libraries, Experiment& experiment);

// Uses every metric of the experiment's libraries with its defaults, those of recoveries only if robots have them. `at`: the place for errors. Throws InputError.
void use_every_metric(const TomlValue& at, Experiment& experiment);

}  // namespace dmrp::host
