// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/command_output.hpp"
#include "host/commands/commands.hpp"
#include "host/experiment/experiment.hpp"
#include "host/plan/check_planners.hpp"

namespace dmrp::host {

int validate_command(const std::filesystem::path& file) {
  const Experiment experiment = load_experiment(file, 0);
  check_planners(experiment, file);
  for (const std::string& warning : experiment.warnings) warn(warning);
  const std::size_t count = combinations(experiment).size();
  fmt::print("{}: good. {} of {}: {} trials, {} metrics\n", file.string(), plural(count, "combination"),
             plural(experiment.trials, "repetition"), count * experiment.trials, experiment.metrics.size());
  return exit_status::done;
}

}  // namespace dmrp::host
