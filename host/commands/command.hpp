// SPDX-License-Identifier: MIT
// command.hpp: what all commands have in common. A command throws InputError, MachineError, std::system_error or
// std::runtime_error, which main() reports.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "host/program/exit_status.hpp"

// The commands of `dmrp-host`, in the order of its help. Each has a file, whose function add_COMMAND() registers it with
// its options.
#define DMRP_COMMANDS(COMMAND) \
  COMMAND(run)                 \
  COMMAND(validate)            \
  COMMAND(plugins)             \
  COMMAND(check)               \
  COMMAND(draw)                \
  COMMAND(video)               \
  COMMAND(evaluate)            \
  COMMAND(merge)               \
  COMMAND(bundle)              \
  COMMAND(verify)              \
  COMMAND(compare)             \
  COMMAND(export)              \
  COMMAND(plan)                \
  COMMAND(keys)                \
  COMMAND(new)                 \
  COMMAND(report)

namespace dmrp::host {

#define DMRP_DECLARE(name) void add_##name(CLI::App& app);
DMRP_COMMANDS(DMRP_DECLARE)
#undef DMRP_DECLARE

// The end of a help text: an example, and the exit statuses.
std::string help_footer(const std::string& example);

// Ends the command's help with an example, and runs the command when it was given. What it returns is the exit status:
// the command line is left by CLI::RuntimeError, which holds it.
void finish_command(CLI::App* command, const std::string& example, std::function<int()> run);

// Lines of at most 80 columns.
class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
};

unsigned default_jobs();  // one per core

// The commands run and verify have this flag.
inline constexpr const char* trust_help = "run plugins of a bundle where the kernel gives them no namespaces";

}  // namespace dmrp::host
