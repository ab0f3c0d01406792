// SPDX-License-Identifier: MIT
// arguments.hpp: the command that the arguments mean.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace dmrp::host {

// The arguments with a command or an option first. `EXPERIMENT.toml` means `run EXPERIMENT.toml`, also with options before
// it, and `help COMMAND` means `COMMAND --help`. Throws InputError if the program has no such command.
std::vector<std::string> arguments_with_command(const CLI::App& program, std::vector<std::string> arguments);

}  // namespace dmrp::host
