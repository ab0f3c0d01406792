// SPDX-License-Identifier: MIT
#include "host/errors/escaped_text.hpp"

#include <cstdint>
#include <cstring>

namespace dmrp::host {

namespace {

constexpr std::size_t most_bytes = 4000;

struct Character {
  std::size_t bytes;  // 0 if it is no UTF-8
  std::uint32_t code_point;
};

// The first character of `text`, which is not empty. Overlong forms, surrogates and what lies beyond U+10FFFF are no
// UTF-8 (RFC 3629).
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  if (byte(0) < 0x80) return {1, byte(0)};
  const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return {0, 0};
  std::uint32_t code_point = byte(0) & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {0, 0};
    code_point = code_point << 6 | (byte(i) & 0x3F);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code_point >= 0xD800 && code_point <= 0xDFFF;
  return code_point < least[bytes] || code_point > 0x10FFFF || surrogate ? Character{0, 0}
                                                                         : Character{bytes, code_point};
}

bool is_control(std::uint32_t code_point) {
  return code_point < 0x20 || (code_point >= 0x7F && code_point < 0xA0) || code_point == 0x2028 || code_point == 0x2029;
}

void append_escape(std::string& out, std::uint8_t byte) {
  constexpr char digits[] = "0123456789abcdef";
  if (byte == '\n') {
    out += "\\n";
  } else if (byte == '\t') {
    out += "\\t";
  } else {
    out += "\\x";
    out += digits[byte >> 4];
    out += digits[byte & 15];
  }
}

}  // namespace

bool is_plain(std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (character.bytes == 0 || is_control(character.code_point)) return false;
    text.remove_prefix(character.bytes);
  }
  return true;
}

std::string escaped(const char* text) {
  std::string out;
  std::string_view rest = text ? std::string_view(text, strnlen(text, most_bytes)) : std::string_view();
  const bool is_cut = rest.size() == most_bytes;
  while (!rest.empty()) {
    const Character character = first_character(rest);
    if (character.bytes == 0 && is_cut && rest.size() < 4) break;  // the rest of that character was cut off
    const std::size_t bytes = character.bytes == 0 ? 1 : character.bytes;
    if (character.bytes == 0 || is_control(character.code_point))
      for (std::size_t i = 0; i < bytes; ++i) append_escape(out, static_cast<std::uint8_t>(rest[i]));
    else
      out += rest.substr(0, bytes);
    rest.remove_prefix(bytes);
  }
  return out;
}

}  // namespace dmrp::host
