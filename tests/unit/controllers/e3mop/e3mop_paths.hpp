// SPDX-License-Identifier: MIT
// e3mop_paths.hpp: windows with discs, and paths among them.
#pragma once

#include <algorithm>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "tests/unit/controllers/e3mop/e3mop_window.hpp"

namespace dmrp::test {

using Points = std::vector<dmrp_vec2>;

inline Window discs_window(const std::vector<dmrp_vec2>& discs, double radius_m) {
  return Window({0.0, 0.0, 0.0}, [&](dmrp_vec2 point) {
    return std::any_of(discs.begin(), discs.end(),
                       [&](dmrp_vec2 disc) { return toolkit::distance(disc, point) < radius_m; });
  });
}

inline Points straight(dmrp_vec2 from, dmrp_vec2 to, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.push_back(toolkit::lerp(from, to, i / (count - 1.0)));
  return points;
}

// A zigzag path of free points among discs.
inline Points wavering(toolkit::Stream& random, const controllers::e3mop::ClearanceField& field) {
  while (true) {
    const double to_y = random.uniform(-1.0, 1.0);  // one draw after the other, whatever the compiler
    const double from_y = random.uniform(-1.0, 1.0);
    Points points = straight({-1.5, from_y}, {1.5, to_y}, 31);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      points[i] += {random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)};
    if (std::all_of(points.begin(), points.end(), [&](dmrp_vec2 point) { return field.at(point).distance_m >= 0.3; }))
      return points;
  }
}

}  // namespace dmrp::test
