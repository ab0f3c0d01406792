// SPDX-License-Identifier: MIT
// plugins_markdown.hpp: what a plugin library holds as a reference page.
#pragma once

#include <string>
#include <vector>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

// "0 to 1", ">= 0", "one of a, b"; empty where everything is allowed.
std::string parameter_range(const ParameterSpec& spec);

// Begins with a comment that says how it was made. `library` is the file's name alone: the page must not depend on the
// machine.
std::string plugins_markdown(const std::string& library, const std::vector<PluginInfo>& plugins);

}  // namespace dmrp::host
