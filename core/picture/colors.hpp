// SPDX-License-Identifier: MIT
// colors.hpp: the colours of pictures, and what of a world is a wall.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dmrp::core {

inline constexpr double wall_height_m = 2.0;  // shapes at least this tall are walls, lower ones furniture

// A colour on paper.
struct Ink {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  double opacity = 1.0;

  constexpr Ink fainter(double share) const { return {red, green, blue, share * opacity}; }
  bool operator==(const Ink&) const = default;
};

// 0x0072b2
constexpr Ink ink_of(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb)};
}

// The colour of a robot, as in the report; they repeat after 24. The first six are Okabe's and Ito's (2008), which differ
// under every kind of colour vision; robots have numbers besides.
constexpr Ink robot_ink(std::size_t robot) {
  constexpr std::array<std::uint32_t, 24> series = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7, 0xe69f00, 0x56b4e9,
                                                    0x3a3f45, 0xb8a800, 0x000db8, 0x8e52fd, 0x8e4f6a, 0x5b007f,
                                                    0x830f05, 0x715b13, 0xcc0e9e, 0x4643d0, 0x7e7fd0, 0xcc103d,
                                                    0x511522, 0xd1a194, 0xf6486f, 0xc66cf7, 0x7f1f63, 0x352053};
  return ink_of(series[robot % series.size()]);
}

}  // namespace dmrp::core
