// SPDX-License-Identifier: MIT
// machine_error.hpp: the machine failed: a full disk, an I/O error, no memory, no more processes, a folder that vanished
// during the run. One line; exit status 3.
#pragma once

#include <exception>
#include <string>
#include <system_error>

namespace dmrp::host {

// Not a std::runtime_error: code that turns those into an InputError, or into the fault of one plugin, lets it pass.
class MachineError : public std::exception {
 public:
  explicit MachineError(std::string line);
  // "WHAT: No space left on device", for a value of errno.
  MachineError(const std::string& what, int error_number);

  const char* what() const noexcept override { return line_.c_str(); }

 private:
  std::string line_;
};

// Whether it is a MachineError, std::bad_alloc or std::system_error.
bool is_machine_failure(const std::exception& error);

// Throws "WHAT: the error's text", for a path that the user named: an InputError if another path would do (this one is
// missing, is a folder, or access is denied), otherwise a MachineError.
[[noreturn]] void throw_path_error(const std::string& what, const std::error_code& error);

// The text of an exception for the user, in one line.
std::string error_text(const std::exception& error);

}  // namespace dmrp::host
