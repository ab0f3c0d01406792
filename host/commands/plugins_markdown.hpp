// SPDX-License-Identifier: MIT
// plugins_markdown.hpp: a reference page of a plugin library.
#pragma once

#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// "0 to 1", ">= 0", "one of a, b"; empty without limits.
std::string parameter_range(const ParameterSpec& spec);

// Begins with a comment that names the command. `library` is the file's name without its folder: the page must not depend
// on the machine.
std::string plugins_markdown(const std::string& library, const std::vector<PluginInfo>& plugins);

}  // namespace dmrp::host
