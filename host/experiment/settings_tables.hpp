// SPDX-License-Identifier: MIT
// settings_tables.hpp: the tables [simulation], [robot], [record] and [limits] of an experiment file: one list of keys
// for reading and writing.
#pragma once

#include <string>
#include <vector>

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// The readers of these tables for root.read(). Both arguments must outlive the readers.
std::vector<TomlTable::KeyReader> settings_readers(const TomlTable& root, Experiment& experiment);

// The keys of these tables and of their subtables.
std::vector<TomlKeys> settings_keys();

// These tables as TOML text, with all keys.
std::string settings_text(const Experiment& experiment);

}  // namespace dmrp::host
