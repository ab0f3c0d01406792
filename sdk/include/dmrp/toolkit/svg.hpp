// SPDX-License-Identifier: MIT
// svg.hpp: what figures in SVG need: colours of series, escaped text, short numbers.
#pragma once

#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dmrp::toolkit {

// The palette of Okabe and Ito (2008), whose colours differ under colour blindness; it repeats after eight.
inline std::string_view series_color(std::size_t index) {
  constexpr std::array<std::string_view, 8> colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#000000", "#f0e442"};
  return colors[index % colors.size()];
}

// Escapes text for use between tags and in attributes. Control characters, which XML forbids, become spaces.
inline std::string escape_xml(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

// At most two decimals, rounded half away from zero, no trailing zeros, never "-0". Finite, below 1e15.
inline std::string format_svg_number(double value) {
  assert(std::abs(value) < 1e15);
  const std::int64_t hundredths = std::llround(std::abs(value) * 100.0);
  std::string text = value < 0.0 && hundredths != 0 ? "-" : "";
  text += std::to_string(hundredths / 100);
  const auto decimals = static_cast<char>(hundredths % 100);
  if (decimals != 0) {
    text += '.';
    text += static_cast<char>('0' + decimals / 10);
    if (decimals % 10 != 0) text += static_cast<char>('0' + decimals % 10);
  }
  return text;
}

}  // namespace dmrp::toolkit
