// SPDX-License-Identifier: MIT
// check_descriptor.hpp: what makes a descriptor invalid, or one that this host cannot use.
#pragma once

#include <dmrp/descriptor.h>

#include <string>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// Why this host cannot use the plugin although its descriptor may be valid in a newer minor version, in one line: a kind,
// a connectivity or a type of parameter that this host does not know. "" if it can use it.
std::string unknown_part(const PluginInfo& info);

// Throws std::runtime_error, in one line, if the descriptor breaks a rule of descriptor.h or parameter.h.
void check_descriptor(const PluginInfo& info);

// Whether the id is one of the built-in plugins' ("dmrp.").
bool is_reserved_id(const std::string& id);

}  // namespace dmrp::host
