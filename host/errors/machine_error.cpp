// SPDX-License-Identifier: MIT
#include "host/errors/machine_error.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <utility>

#include "host/errors/input_error.hpp"
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

bool is_machine_failure(const std::exception& error) {
  return dynamic_cast<const MachineError*>(&error) || dynamic_cast<const std::bad_alloc*>(&error) ||
         dynamic_cast<const std::system_error*>(&error);
}

void throw_path_error(const std::string& what, const std::error_code& error) {
  const std::string line = what + ": " + error.message();
  if (std::find(errors_of_paths.begin(), errors_of_paths.end(), error) != errors_of_paths.end()) throw InputError(line);
  throw MachineError(line);
}

std::string error_text(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) ? "out of memory" : one_line(error.what());
}

}  // namespace dmrp::host
