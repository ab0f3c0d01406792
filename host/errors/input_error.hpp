// SPDX-License-Identifier: MIT
// input_error.hpp: the user's input cannot be used. One line, `file:line:column: what was expected`; exit status 2.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "host/errors/one_line.hpp"

namespace dmrp::host {

class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string line) : std::runtime_error(one_line(std::move(line))) {}
};

}  // namespace dmrp::host
