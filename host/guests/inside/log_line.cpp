// SPDX-License-Identifier: MIT
#include "host/guests/inside/log_line.hpp"

#include <fmt/format.h>

namespace dmrp::host {

std::string log_line(std::int32_t level, const std::string& plugin, const std::string& text,
                     const std::optional<LoggedTrial>& trial, const CallNote& note) {
  static constexpr const char* const names[] = {"debug", "info", "warning", "error"};
  std::string place;
  if (trial) {
    place = fmt::format(" (trial {}", trial->number);
    const bool inside_a_call = note.call_number % 2 == 1;
    if (inside_a_call && note.robot >= 0) place += fmt::format(", robot {}", note.robot.load());
    if (inside_a_call)
      place += fmt::format(", {:.2f} s", static_cast<double>(note.step) * static_cast<double>(trial->step_ns) * 1e-9);
    place += ")";
  }
  // host.h: an unknown level counts as information
  return fmt::format("[{}] {}{}: {}\n", level >= 0 && level <= 3 ? names[level] : names[1], plugin, place, text);
}

}  // namespace dmrp::host
