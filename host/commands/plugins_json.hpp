// SPDX-License-Identifier: MIT
// plugins_json.hpp: plugins as JSON for other programs: constants of the contract by their names.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/plugins/plugin_info.hpp"

namespace dmrp::host {

nlohmann::ordered_json plugin_as_json(const PluginInfo& info);

}  // namespace dmrp::host
