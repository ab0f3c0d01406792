// SPDX-License-Identifier: MIT
// debug_trial.hpp: one trial for debuggers.
#pragma once

#include <cstdint>
#include <filesystem>

namespace dmrp::host {

// Runs one trial in this process, without limits of time or a box, and prints its values. Returns the exit status.
int debug_trial(const std::filesystem::path& experiment, std::uint32_t trials, std::uint64_t trial);

}  // namespace dmrp::host
