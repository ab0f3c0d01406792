// SPDX-License-Identifier: MIT
// The sum of the pushes of several walls on one person.
#pragma once

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/wall_grid.hpp"

namespace dmrp::pedestrians {

// Each wall pushes with the strength push(distance_m). Walls in similar directions (pieces of one wall, the two sides
// of a corner) share one push, of which nearer walls get more, with the decay length `range_m`. So the sum does not
// depend on the number of pieces of which a wall consists.
template <class Push>
Vec2 push_of_walls(const std::vector<WallPoint>& walls, double range_m, Push&& push) {
  Vec2 sum = {0.0, 0.0};
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
