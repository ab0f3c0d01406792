// SPDX-License-Identifier: MIT
// offered_extensions.hpp: the extensions that this host offers to each kind of plugin.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// The ids for a DMRP_KIND_*.
std::vector<std::string> offered_extensions(std::uint32_t kind);

// What the plugin requires in vain, in one line: "needs the extension X, which ..."; "" if it gets all that it requires.
std::string missing_extension(const PluginInfo& info);

// One line for each extension that the plugin uses and that looks like a misspelt one of this host.
std::vector<std::string> doubtful_extensions(const PluginInfo& info);

}  // namespace dmrp::host
