// SPDX-License-Identifier: MIT
// machine_error.hpp: the machine failed: a full disk, an I/O error, no memory, no more processes. One line; exit
// status 3.
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

// Whether the machine is the cause. Errors that a path can have (it is missing, it is a folder, access is denied, the
// file system is read-only) are the user's to correct.
bool is_machine_failure(const std::error_code& code);

// The same for an exception: a MachineError, std::bad_alloc, or a std::system_error with such a code.
bool is_machine_failure(const std::exception& error);

// The text of an exception for the user, in one line.
std::string error_text(const std::exception& error);

}  // namespace dmrp::host
