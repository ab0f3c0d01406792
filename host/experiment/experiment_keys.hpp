// SPDX-License-Identifier: MIT
// experiment_keys.hpp: the format of experiment files, as their reader knows it.
#pragma once

#include <vector>

#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// All tables of the format, with their keys.
std::vector<TomlKeys> experiment_keys();

}  // namespace dmrp::host
