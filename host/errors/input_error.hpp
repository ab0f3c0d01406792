// SPDX-License-Identifier: MIT
// input_error.hpp: what the user gave cannot be used. One line, `file:line:column: what was expected`; exit status 2.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace dmrp::host {

class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string line) : std::runtime_error(one_line(std::move(line))) {}

 private:
  // Messages quote what files say, and they may say line breaks.
  static std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    return text;
  }
};

}  // namespace dmrp::host
