// SPDX-License-Identifier: MIT
// segment.hpp: distances and intersections of straight segments, metres. A segment of length zero counts as a point.
#pragma once

#include <algorithm>
#include <optional>

#include "vec2.hpp"

namespace dmrp::toolkit {

inline double length(const dmrp_segment& segment) {
  return distance(segment.from, segment.to);
}

// The position on the segment of the point nearest to `point`: 0 at `from`, 1 at `to`.
inline double closest_fraction(const dmrp_segment& segment, dmrp_vec2 point) {
  const dmrp_vec2 along = segment.to - segment.from;
  const double squared_length = squared_norm(along);
  if (!(squared_length > 0.0)) return 0.0;
  return std::clamp(dot(point - segment.from, along) / squared_length, 0.0, 1.0);
}

inline dmrp_vec2 closest_point(const dmrp_segment& segment, dmrp_vec2 point) {
  return lerp(segment.from, segment.to, closest_fraction(segment, point));
}

inline double squared_distance(const dmrp_segment& segment, dmrp_vec2 point) {
  return squared_distance(closest_point(segment, point), point);
}

inline double distance(const dmrp_segment& segment, dmrp_vec2 point) {
  return distance(closest_point(segment, point), point);
}

// The side of the line a -> b on which the point lies: positive left, negative right, 0 on the line. The value is twice
// the signed area of the triangle.
constexpr double orientation(dmrp_vec2 a, dmrp_vec2 b, dmrp_vec2 point) {
  return cross(b - a, point - a);
}

// Whether the segments have a common point; touching counts. Decided by the signs of orientations in double precision.
inline bool intersects(const dmrp_segment& a, const dmrp_segment& b) {
  const double b_from = orientation(a.from, a.to, b.from);
  const double b_to = orientation(a.from, a.to, b.to);
  const double a_from = orientation(b.from, b.to, a.from);
  const double a_to = orientation(b.from, b.to, a.to);
  const auto opposite = [](double one, double other) {
    return (one < 0.0 && other > 0.0) || (one > 0.0 && other < 0.0);
  };
  if (opposite(b_from, b_to) && opposite(a_from, a_to)) return true;
  // An end on the line of the other segment touches that segment if it also lies between its ends.
  const auto within = [](const dmrp_segment& box, dmrp_vec2 point) {
    return std::min(box.from.x, box.to.x) <= point.x && point.x <= std::max(box.from.x, box.to.x) &&
           std::min(box.from.y, box.to.y) <= point.y && point.y <= std::max(box.from.y, box.to.y);
  };
  return (b_from == 0.0 && within(a, b.from)) || (b_to == 0.0 && within(a, b.to)) ||
         (a_from == 0.0 && within(b, a.from)) || (a_to == 0.0 && within(b, a.to));
}

// The common point; for an overlap along a line, the one nearest to a.from. Empty if there is none.
inline std::optional<dmrp_vec2> intersection(const dmrp_segment& a, const dmrp_segment& b) {
  if (!intersects(a, b)) return std::nullopt;
  const dmrp_vec2 along_a = a.to - a.from;
  const double denominator = cross(along_a, b.to - b.from);
  if (denominator != 0.0) {
    const double fraction = cross(b.from - a.from, b.to - b.from) / denominator;
    return lerp(a.from, a.to, std::clamp(fraction, 0.0, 1.0));
  }
  // Along one line: the overlap begins at a.from or at b's nearer end.
  const double squared_length = squared_norm(along_a);
  if (squared_length == 0.0) return a.from;
  const double nearer_end = std::min(dot(b.from - a.from, along_a), dot(b.to - a.from, along_a)) / squared_length;
  return lerp(a.from, a.to, std::clamp(nearer_end, 0.0, 1.0));
}

// 0 if they cross or touch.
inline double distance(const dmrp_segment& a, const dmrp_segment& b) {
  if (intersects(a, b)) return 0.0;
  const double nearest = std::min(
      {squared_distance(a, b.from), squared_distance(a, b.to), squared_distance(b, a.from), squared_distance(b, a.to)});
  return std::sqrt(nearest);
}

}  // namespace dmrp::toolkit
