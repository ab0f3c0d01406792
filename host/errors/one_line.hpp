// SPDX-License-Identifier: MIT
// one_line.hpp: error texts quote files and plugins, whose bytes may include line breaks; an error is one line.
#pragma once

#include <algorithm>
#include <string>

namespace dmrp::host {

// Replaces control characters by spaces.
inline std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text;
}

}  // namespace dmrp::host
