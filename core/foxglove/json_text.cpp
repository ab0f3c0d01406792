// SPDX-License-Identifier: MIT
#include "core/foxglove/json_text.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace dmrp::core {
namespace {

constexpr double steps_per_unit = 10'000.0;  // four decimals
constexpr double max_steps = 9.0e15;         // larger doubles do not represent every integer

char hex_digit(unsigned value) {
  return "0123456789abcdef"[value & 15u];
}

}  // namespace

JsonText& JsonText::string(std::string_view text) {
  text_ += '"';
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text_ += '\\';
      text_ += c;
    } else if (byte < 0x20) {
      text_.append("\\u00");
      text_ += hex_digit(byte >> 4);
      text_ += hex_digit(byte);
    } else {
      text_ += c;
    }
  }
  text_ += '"';
  return *this;
}

JsonText& JsonText::integer(std::int64_t value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text_.append(digits.data(), end);
  return *this;
}

JsonText& JsonText::number(double value) {
  const double steps = value * steps_per_unit;
  if (!(std::abs(steps) < max_steps)) return integer(0);
  auto rest = static_cast<std::int64_t>(std::abs(steps) + 0.5);
  if (rest == 0) return integer(0);  // no "-0"
  if (value < 0.0) text_ += '-';
  integer(rest / 10'000);
  rest %= 10'000;
  if (rest == 0) return *this;
  std::array<char, 5> decimals{'.', '0', '0', '0', '0'};
  for (std::size_t i = 4; i > 0; --i, rest /= 10) decimals[i] = static_cast<char>('0' + rest % 10);
  std::size_t length = decimals.size();
  while (decimals[length - 1] == '0') --length;
  text_.append(decimals.data(), length);
  return *this;
}

JsonText& JsonText::comma_unless_first() {
  if (!text_.empty()) text_ += ',';
  return *this;
}

}  // namespace dmrp::core
