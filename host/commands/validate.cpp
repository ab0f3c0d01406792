// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command.hpp"
#include "host/commands/command_output.hpp"
#include "host/experiment/experiment.hpp"
#include "host/guests/probe.hpp"
#include "host/plan/check_planners.hpp"

namespace dmrp::host {
namespace {

int validate_command(const std::filesystem::path& file) {
  const Experiment experiment = load_experiment(file, 0, &probe_library);
  check_planners(experiment, file);
  for (const std::string& warning : experiment.warnings) warn(warning);
  const std::size_t count = combinations(experiment).size();
  fmt::print("{}: good. {} of {}: {} trials, {} metrics\n", file.string(), plural(count, "combination"),
             plural(experiment.trials, "repetition"), count * experiment.trials, experiment.metrics.size());
  return exit_status::done;
}

}  // namespace

void add_validate(CLI::App& app) {
  const auto file = std::make_shared<std::filesystem::path>();
  CLI::App* command = app.add_subcommand("validate", "check an experiment without running it");
  command->add_option("experiment", *file, "experiment file")->required()->type_name("EXPERIMENT.toml");
  finish_command(command, "dmrp-host validate examples/quickstart.toml", [file] { return validate_command(*file); });
}

}  // namespace dmrp::host
