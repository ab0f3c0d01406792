// SPDX-License-Identifier: MIT
// rectangle.hpp: axis-aligned rectangles, metres; the border belongs to the rectangle.
#pragma once

#include <algorithm>
#include <cassert>

#include "vec2.hpp"

namespace dmrp::toolkit {

// A point or a line if its corners' coordinates are equal.
struct Rectangle {
  dmrp_vec2 lower = {0.0, 0.0};
  dmrp_vec2 upper = {0.0, 0.0};
};

// Functions that take a rectangle expect that it is.
constexpr bool is_ordered(const Rectangle& rectangle) {
  return rectangle.lower.x <= rectangle.upper.x && rectangle.lower.y <= rectangle.upper.y;
}

constexpr bool contains(const Rectangle& rectangle, dmrp_vec2 point) {
  return rectangle.lower.x <= point.x && point.x <= rectangle.upper.x && rectangle.lower.y <= point.y &&
         point.y <= rectangle.upper.y;
}

constexpr bool touch(const Rectangle& one, const Rectangle& other) {
  return one.lower.x <= other.upper.x && other.lower.x <= one.upper.x && one.lower.y <= other.upper.y &&
         other.lower.y <= one.upper.y;
}

inline dmrp_vec2 closest_point(const Rectangle& rectangle, dmrp_vec2 point) {
  assert(is_ordered(rectangle));
  return {std::clamp(point.x, rectangle.lower.x, rectangle.upper.x),
          std::clamp(point.y, rectangle.lower.y, rectangle.upper.y)};
}

// 0 inside.
inline double distance(const Rectangle& rectangle, dmrp_vec2 point) {
  return distance(closest_point(rectangle, point), point);
}

// The distance from a point inside to the nearest side. Outside it is negative: the largest distance by which the point
// lies beyond the line of a side.
constexpr double depth(const Rectangle& rectangle, dmrp_vec2 point) {
  return std::min(std::min(point.x - rectangle.lower.x, rectangle.upper.x - point.x),
                  std::min(point.y - rectangle.lower.y, rectangle.upper.y - point.y));
}

}  // namespace dmrp::toolkit
