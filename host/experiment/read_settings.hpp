// SPDX-License-Identifier: MIT
// read_settings.hpp: the tables [simulation], [robot], [record] and [limits] of an experiment file.
#pragma once

#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// What root.read() calls for these tables. Both arguments outlive the readers.
std::vector<TomlTable::KeyReader> settings_readers(const TomlTable& root, Experiment& experiment);

// The keys of these tables and of those in them. `root`: of any document.
std::vector<TomlKeys> settings_keys(const TomlTable& root);

}  // namespace dmrp::host
