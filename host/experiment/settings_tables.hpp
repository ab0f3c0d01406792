// SPDX-License-Identifier: MIT
// settings_tables.hpp: the tables [simulation], [recovery], [navigation], [ending], [robot], [record],
// [benchmark] and [limits] of an experiment file: one list of keys for reading and writing.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/setting.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// Reads [simulation], [recovery], [navigation], [ending], [robot] and [robot_type.NAME]. Throws InputError.
void read_world_settings(const TomlTable& root, Experiment& experiment);

// Reads [record], [benchmark] and [limits]. Throws InputError.
void read_run_settings(const TomlTable& root, Experiment& experiment);

Settings simulation_settings(core::SimulationSettings& to);
Settings recovery_settings(core::RecoverySettings& to);
Settings navigation_settings(core::NavigationSettings& to);

// The grid_resolution_m of "auto" while it is read.
inline constexpr double cells_to_choose_m = 0.0;

// Refuses settings that do not fit together, at their keys in `table`. Throws InputError.
void check_simulation(const TomlTable& table, const core::SimulationSettings& simulation);

// The keys of these tables and of their subtables.
std::vector<TomlKeys> settings_keys();

// These tables as TOML text, with all keys.
std::string settings_text(const Experiment& experiment);

}  // namespace dmrp::host
