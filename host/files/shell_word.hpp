// SPDX-License-Identifier: MIT
// shell_word.hpp: printed commands can be pasted, whatever blanks are in their paths.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dmrp::host {

// The word as a shell reads it back: in quotes if it has anything but letters, digits and what no shell interprets.
inline std::string shell_word(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+:,./-=";
  const auto is_plain = [&](char c) {
    return plain.find(c) != std::string_view::npos || static_cast<unsigned char>(c) >= 0x80;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace dmrp::host
