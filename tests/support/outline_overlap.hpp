// SPDX-License-Identifier: MIT
// How deep two outlines overlap, from first principles. Shares no code with core, host or plugins.
#pragma once

#include <dmrp/values.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace dmrp::test {

// What a robot covers at one moment: a disc, or a convex polygon.
struct Outline {
  double radius_m = 0;
  std::vector<dmrp_vec2> corners{};
};

// How deep two outlines overlap, at least; negative if they are apart. For polygons and discs by the axis of least
// overlap among the normals of all sides and, with a disc, the directions from its centre to the corners.
inline double overlap_depth(const Outline& a, dmrp_vec2 at_a, const Outline& b, dmrp_vec2 at_b) {
  std::vector<dmrp_vec2> axes;
  const auto add = [&axes](double x, double y) {
    if (const double length = std::hypot(x, y); length > 1e-12) axes.push_back({x / length, y / length});
  };
  const auto add_sides = [&](const Outline& outline) {
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
      const dmrp_vec2 p = outline.corners[i];
      const dmrp_vec2 q = outline.corners[(i + 1) % outline.corners.size()];
      add(q.y - p.y, p.x - q.x);
    }
  };
  const auto add_corners = [&](const Outline& outline, dmrp_vec2 at, dmrp_vec2 center) {
    for (const dmrp_vec2 corner : outline.corners) add(at.x + corner.x - center.x, at.y + corner.y - center.y);
  };
  add_sides(a);
  add_sides(b);
  if (a.corners.empty()) add_corners(b, at_b, at_a);
  if (b.corners.empty()) add_corners(a, at_a, at_b);
  if (a.corners.empty() && b.corners.empty()) add(at_a.x - at_b.x, at_a.y - at_b.y);
  if (axes.empty()) add(1, 0);
  const auto extent = [](const Outline& outline, dmrp_vec2 at, dmrp_vec2 axis) {
    const double middle = at.x * axis.x + at.y * axis.y;
    if (outline.corners.empty()) return std::pair(middle - outline.radius_m, middle + outline.radius_m);
    std::pair<double, double> range{1e9, -1e9};
    for (const dmrp_vec2 corner : outline.corners) {
      const double along = middle + corner.x * axis.x + corner.y * axis.y;
      range = {std::min(range.first, along), std::max(range.second, along)};
    }
    return range;
  };
  double depth = 1e9;
  for (const dmrp_vec2 axis : axes) {
    const auto [low_a, high_a] = extent(a, at_a, axis);
    const auto [low_b, high_b] = extent(b, at_b, axis);
    depth = std::min(depth, std::min(high_a, high_b) - std::max(low_a, low_b));
  }
  return depth;
}

}  // namespace dmrp::test
