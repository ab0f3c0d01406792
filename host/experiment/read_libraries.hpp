// SPDX-License-Identifier: MIT
// read_libraries.hpp: the key `plugins` of [experiment]: finds and probes the plugin libraries.
#pragma once

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// Adds the libraries to the experiment, and their warnings. `plugins`: the value of the key. Throws InputError.
void read_libraries(const TomlDocument& document, const TomlValue& plugins, const PluginSource& source,
                    Experiment& experiment);

// Whether all libraries that the file names have been read. If not, nothing can be said about plugins that are missing.
bool has_all_libraries(const TomlTable& root, const Experiment& experiment);

}  // namespace dmrp::host
