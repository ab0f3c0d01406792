// SPDX-License-Identifier: MIT
#include "host/workers/rerun_command.hpp"

#include <fmt/format.h>

#include "host/files/shell_word.hpp"

namespace dmrp::host {
std::string rerun_command(const Experiment& experiment, std::uint64_t trial, std::uint64_t trial_count) {
  return fmt::format("dmrp-host run {} --trials {} --shard {}/{} --out rerun-{}", shell_word(experiment.file.string()),
                     experiment.trials, trial, trial_count, trial);
}

}  // namespace dmrp::host
