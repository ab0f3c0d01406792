// SPDX-License-Identifier: MIT
// read_settings.hpp: the tables [simulation], [robot], [record] and [limits] of an experiment file.
#pragma once

#include "host/experiment/experiment.hpp"
#include "host/experiment/toml_document.hpp"

namespace dmrp::host {

void read_settings(TomlTable& root, Experiment& experiment);

}  // namespace dmrp::host
