// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command_output.hpp"
#include "host/commands/commands.hpp"
#include "host/experiment/experiment_keys.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {

int keys_command(const std::string& format) {
  for (const TomlKeys& table : format == "experiment" ? experiment_keys() : scenario_keys()) {
    fmt::print("{}\n", table.title);
    for (const TomlKey& key : table.keys)
      fmt::print("  {}{}{}\n", key.name, key.fallback.empty() ? "" : " = " + key.fallback,
                 key.range.empty() ? "" : "  # " + key.range);
  }
  return exit_status::done;
}

}  // namespace dmrp::host
