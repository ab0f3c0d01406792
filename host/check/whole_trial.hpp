// SPDX-License-Identifier: MIT
// whole_trial.hpp: a plugin's first trial as a run has it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "host/check/case_process.hpp"

namespace dmrp::host {

// Two robots cross a room with a few people; shipped plugins have the other roles. Skipped where those are not found.
// Throws MachineError.
CaseOutcome run_whole_trial(const std::filesystem::path& file, const PluginInfo& plugin, std::uint64_t seed);

}  // namespace dmrp::host
