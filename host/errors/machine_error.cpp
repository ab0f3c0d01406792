// SPDX-License-Identifier: MIT
#include "host/errors/machine_error.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "host/errors/one_line.hpp"

namespace dmrp::host {

namespace {

constexpr std::array errors_of_paths = {
    std::errc::no_such_file_or_directory,
    std::errc::permission_denied,
    std::errc::operation_not_permitted,
    std::errc::not_a_directory,
    std::errc::is_a_directory,
    std::errc::filename_too_long,
    std::errc::too_many_symbolic_link_levels,
    std::errc::read_only_file_system,
    std::errc::file_exists,
    std::errc::directory_not_empty,
};

}  // namespace

MachineError::MachineError(std::string line) : line_(one_line(std::move(line))) {}

MachineError::MachineError(const std::string& what, int error_number)
    : MachineError(what + ": " + std::generic_category().message(error_number)) {}

bool is_machine_failure(const std::error_code& code) {
  return std::none_of(errors_of_paths.begin(), errors_of_paths.end(),
                      [&](std::errc path_error) { return code == path_error; });
}

bool is_machine_failure(const std::exception& error) {
  if (dynamic_cast<const MachineError*>(&error) || dynamic_cast<const std::bad_alloc*>(&error)) return true;
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return system && is_machine_failure(system->code());
}

std::string error_text(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) ? "out of memory" : one_line(error.what());
}

}  // namespace dmrp::host
