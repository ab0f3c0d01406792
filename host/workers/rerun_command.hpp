// SPDX-License-Identifier: MIT
// rerun_command.hpp: the command that runs one trial again, as fault records show it.
#pragma once

#include <cstdint>
#include <string>

#include "host/experiment/experiment.hpp"

namespace dmrp::host {

// `trial_count`: of the whole experiment.
std::string rerun_command(const Experiment& experiment, std::uint64_t trial, std::uint64_t trial_count);

}  // namespace dmrp::host
