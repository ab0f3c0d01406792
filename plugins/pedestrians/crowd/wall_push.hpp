// SPDX-License-Identifier: MIT
// What several walls do to somebody together.
#pragma once

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/wall_grid.hpp"

namespace dmrp::pedestrians {

// Each wall pushes as hard as push(distance_m) says. Where several lie in much the same direction (pieces of one wall,
// the two sides of a corner) they share one push between them, the nearer ones most of it, over `range_m`: so it makes
// no difference of how many pieces a wall is made.
template <class Push>
dmrp_vec2 push_of_walls(const std::vector<WallPoint>& walls, double range_m, Push&& push) {
  dmrp_vec2 sum = {0.0, 0.0};
  for (const WallPoint& wall : walls) {
    const double strength = push(wall.distance_m);
    if (!(strength > 0.0)) continue;
    double sharers = 0.0;
    for (const WallPoint& other : walls) {
      const double alike = toolkit::dot(wall.away, other.away);
      if (alike > 0.0) sharers += alike * std::exp((wall.distance_m - other.distance_m) / range_m);
    }
    sum += wall.away * (strength / sharers);
  }
  return sum;
}

}  // namespace dmrp::pedestrians
