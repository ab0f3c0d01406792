// SPDX-License-Identifier: MIT
#include "host/commands/arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "host/errors/input_error.hpp"
#include "host/toml/nearest_name.hpp"

namespace dmrp::host {

std::vector<std::string> arguments_with_command(const CLI::App& program, std::vector<std::string> arguments) {
  if (arguments.empty()) return {"--help"};
  const auto is_file = [](const std::string& argument) { return argument.ends_with(".toml"); };
  if (arguments[0] == "help" && (arguments.size() == 1 || !arguments[1].starts_with("-"))) {
    std::rotate(arguments.begin(), arguments.begin() + 1, arguments.end());
    arguments.back() = "--help";
  } else if ((arguments[0].starts_with("-") || is_file(arguments[0])) &&
             std::any_of(arguments.begin(), arguments.end(), is_file)) {
    arguments.insert(arguments.begin(), "run");
  }

  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  const std::string& written = arguments.front();
  if (written.starts_with("-") || std::find(names.begin(), names.end(), written) != names.end()) return arguments;
  throw InputError("dmrp-host: there is no command '" + written + "'" + did_you_mean(written, names) +
                   "; commands are " + join_names(names));
}

}  // namespace dmrp::host
