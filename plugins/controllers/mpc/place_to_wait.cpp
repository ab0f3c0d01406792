// SPDX-License-Identifier: MIT
#include "controllers/mpc/place_to_wait.hpp"

#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::mpc {

namespace {

// The place is at most so far beside the path.
constexpr double aside_m = 1.0;

}  // namespace

bool leads_past(const Guide& guide, const CostmapView& map, const std::vector<Vec2>& points) {
  const Vec2 aside = toolkit::perpendicular(toolkit::normalized(points.back() - points[points.size() - 2]));
  for (double offset_m = -aside_m; offset_m <= aside_m; offset_m += map.resolution_m())
    if (guide.reaches(map, points.back() + offset_m * aside)) return true;
  return false;
}

Vec2 place_to_wait(const Guide& guide, const CostmapView& map, const std::vector<Vec2>& points, std::size_t last) {
  const Vec2 ahead = points[last / 2 + 1] - points[last / 2];
  const Vec2 on_path = last % 2 == 0 ? points[last / 2] : points[last / 2] + 0.5 * ahead;
  if (!guide.reaches(map, on_path)) return points[last];
  const Vec2 step = -map.resolution_m() * toolkit::perpendicular(toolkit::normalized(ahead));
  const int most = static_cast<int>(aside_m / map.resolution_m());
  int steps = 0;
  while (steps < most && guide.reaches(map, on_path + (steps + 1) * step)) ++steps;
  return on_path + steps * step;
}

}  // namespace dmrp::controllers::mpc
