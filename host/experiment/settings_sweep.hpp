// SPDX-License-Identifier: MIT
// settings_sweep.hpp: `sweep = { ... }` of [simulation], [recovery] and [robot].
#pragma once

#include <vector>

#include "core/scene/settings.hpp"
#include "host/experiment/experiment.hpp"
#include "host/toml/swept_value.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// One combination of the swept values.
struct SettingsPoint {
  core::SimulationSettings simulation;
  core::RobotSettings robot;
  std::vector<SweptValue> swept{};
};

// All combinations, the last key changes fastest; the experiment's own settings alone if nothing is swept. Values of a
// sweep replace those of their table. Sets experiment.sweeps. Throws InputError.
std::vector<SettingsPoint> read_settings_sweep(const TomlTable& root, Experiment& experiment);

}  // namespace dmrp::host
