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
    for (std::size_t i = 0; i < table.keys.size(); ++i) {
      const std::string range = table.ranges.empty() ? "" : table.ranges[i];
      fmt::print("  {}{}{}\n", table.keys[i], table.defaults.empty() ? "" : " = " + table.defaults[i],
                 range.empty() ? "" : "  # " + range);
    }
  }
  return exit_status::done;
}

}  // namespace dmrp::host
