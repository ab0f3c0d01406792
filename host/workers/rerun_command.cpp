// SPDX-License-Identifier: MIT
#include "host/workers/rerun_command.hpp"

#include <fmt/format.h>

namespace dmrp::host {
namespace {

std::string quoted_for_shell(const std::string& word) {
  if (word.find_first_of(" \t\"'\\$&;()<>|*?`~#!") == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string rerun_command(const Experiment& experiment, std::uint64_t trial, std::uint64_t trial_count) {
  return fmt::format("dmrp-host run {} --trials {} --shard {}/{} --out rerun-{}",
                     quoted_for_shell(experiment.file.string()), experiment.trials, trial, trial_count, trial);
}

}  // namespace dmrp::host
