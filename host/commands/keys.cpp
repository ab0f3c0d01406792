// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command.hpp"
#include "host/experiment/experiment_keys.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::host {
namespace {

int keys_command(const std::string& format) {
  for (const TomlKeys& table : format == "experiment" ? experiment_keys() : scenario_keys()) {
    fmt::print("{}\n", table.title);
    for (const TomlKey& key : table.keys)
      fmt::print("  {}{}{}\n", key.name, key.fallback.empty() ? "" : " = " + key.fallback,
                 key.range.empty() ? "" : "  # " + key.range);
  }
  return exit_status::done;
}

}  // namespace

void add_keys(CLI::App& app) {
  const auto format = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("keys", "list the keys of experiment or scenario files, with their defaults");
  command->add_option("format", *format, "experiment or scenario")
      ->required()
      ->check(CLI::IsMember({"experiment", "scenario"}))
      ->type_name("FORMAT");
  finish_command(command, "dmrp-host keys experiment", [format] { return keys_command(*format); });
}

}  // namespace dmrp::host
