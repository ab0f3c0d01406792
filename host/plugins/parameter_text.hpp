// SPDX-License-Identifier: MIT
// parameter_text.hpp: parameter values as TOML writes them.
#pragma once

#include <string>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

std::string toml_text(const ParameterValue& value);

}  // namespace dmrp::host
