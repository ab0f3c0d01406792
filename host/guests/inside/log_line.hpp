// SPDX-License-Identifier: MIT
// log_line.hpp: log lines of plugins, with the trial, the robot and the simulated time of the call that they come from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/process/call_note.hpp"

namespace dmrp::host {

// The trial that runs.
struct LoggedTrial {
  std::uint64_t number = 0;
  std::int64_t step_ns = 0;  // of a physics step
};

// "[info] org.example.mine (trial 3, robot 1, 12.40 s): text". `note`: of the call that runs; from any thread.
std::string log_line(std::int32_t level, const std::string& plugin, const std::string& text,
                     const std::optional<LoggedTrial>& trial, const CallNote& note);

}  // namespace dmrp::host
