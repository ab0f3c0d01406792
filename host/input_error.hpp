// SPDX-License-Identifier: MIT
// input_error.hpp: what the user gave cannot be used. One line, `file:line:column: what was expected`; exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace dmrp::host {

class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& line) : std::runtime_error(line) {}
};

}  // namespace dmrp::host
