// SPDX-License-Identifier: MIT
#include "host/terminal/colors.hpp"

#include <unistd.h>

#include <cstdlib>

namespace dmrp::host {

namespace {

const char* sequence_of(TextColor color) {
  switch (color) {
    case TextColor::bold:
      return "\x1b[1m";
    case TextColor::red:
      return "\x1b[1;31m";
    case TextColor::green:
      return "\x1b[32m";
    case TextColor::yellow:
      return "\x1b[33m";
    default:
      return "";
  }
}

}  // namespace

bool has_colors(int descriptor) {
  return isatty(descriptor) && allows_colors(std::getenv("TERM"), std::getenv("NO_COLOR"));
}

bool allows_colors(const char* term, const char* no_color) {
  return term && std::string_view(term) != "dumb" && !(no_color && *no_color);
}

std::string colored(std::string_view text, TextColor color, bool colors) {
  if (!colors || color == TextColor::plain) return std::string(text);
  return sequence_of(color) + std::string(text) + "\x1b[0m";
}

}  // namespace dmrp::host
