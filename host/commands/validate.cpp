// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cstdio>

#include "host/commands/commands.hpp"
#include "host/experiment/experiment.hpp"

namespace dmrp::host {

int validate_command(const std::filesystem::path& file) {
  const Experiment experiment = load_experiment(file, 0);
  for (const std::string& warning : experiment.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const std::size_t count = combinations(experiment).size();
  fmt::print("{}: good. {} combination{} of {} repetition{}: {} trials, {} metrics\n", file.string(), count,
             count == 1 ? "" : "s", experiment.trials, experiment.trials == 1 ? "" : "s", count * experiment.trials,
             experiment.metrics.size());
  return exit_status::done;
}

}  // namespace dmrp::host
