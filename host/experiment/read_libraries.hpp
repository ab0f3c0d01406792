// SPDX-License-Identifier: MIT
// read_libraries.hpp: the key `plugins` of [experiment]: finds and probes the plugin libraries.
#pragma once

#include "host/experiment/experiment.hpp"
#include "host/toml/toml_document.hpp"

namespace dmrp::host {

// Adds the libraries to the experiment, and their warnings. `plugins`: the value of the key. `source`, `tried_by`: as
// load_experiment() has them. Throws InputError.
void read_libraries(const TomlDocument& document, const TomlValue& plugins, const PluginSource& source,
                    const PluginSource& tried_by, Experiment& experiment);

// Notes that a library, or a use of a plugin that may be in it, is left out.
void leave_out(const TomlValue& value, const std::string& text, Experiment& experiment);

// Whether all libraries that the file names have been read, or left out. If not, nothing can be said about plugins that
// are missing.
bool has_all_libraries(const TomlTable& root, const Experiment& experiment);

}  // namespace dmrp::host
