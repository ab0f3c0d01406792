// SPDX-License-Identifier: MIT
#include "host/terminal/display_width.hpp"

#include <algorithm>
#include <array>

namespace dmrp::host {
namespace {

struct CodeRange {
  char32_t first;
  char32_t last;
};

constexpr std::array<CodeRange, 7> invisible{{{0x0300, 0x036F},
                                              {0x1AB0, 0x1AFF},
                                              {0x1DC0, 0x1DFF},
                                              {0x200B, 0x200F},
                                              {0x20D0, 0x20FF},
                                              {0xFE00, 0xFE0F},
                                              {0xFE20, 0xFE2F}}};
constexpr std::array<CodeRange, 10> wide{{{0x1100, 0x115F},
                                          {0x2E80, 0x303E},
                                          {0x3041, 0xA4CF},
                                          {0xAC00, 0xD7A3},
                                          {0xF900, 0xFAFF},
                                          {0xFE30, 0xFE6F},
                                          {0xFF00, 0xFF60},
                                          {0xFFE0, 0xFFE6},
                                          {0x1F300, 0x1FAFF},
                                          {0x20000, 0x3FFFD}}};

template <std::size_t count>
bool is_in(const std::array<CodeRange, count>& ranges, char32_t code) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const CodeRange& range) { return range.first <= code && code <= range.last; });
}

bool continues(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u;
}

// Takes the first character off `text`, which is not empty. A broken sequence counts as one character.
char32_t take_character(std::string_view& text) {
  const auto lead = static_cast<unsigned char>(text.front());
  text.remove_prefix(1);
  char32_t code = lead < 0x80u ? lead : lead >= 0xF0u ? lead & 0x07u : lead >= 0xE0u ? lead & 0x0Fu : lead & 0x1Fu;
  if (lead < 0xC0u) return code;
  while (!text.empty() && continues(text.front())) {
    code = code << 6 | (static_cast<unsigned char>(text.front()) & 0x3Fu);
    text.remove_prefix(1);
  }
  return code;
}

std::size_t missing(std::string_view text, std::size_t width) {
  return width - std::min(width, display_width(text));
}

}  // namespace

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    const char32_t code = take_character(text);
    width += is_in(invisible, code) ? 0 : is_in(wide, code) ? 2 : 1;
  }
  return width;
}

std::string pad_right(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(missing(text, width), ' ');
}

std::string pad_left(std::string_view text, std::size_t width) {
  return std::string(missing(text, width), ' ') + std::string(text);
}

}  // namespace dmrp::host
