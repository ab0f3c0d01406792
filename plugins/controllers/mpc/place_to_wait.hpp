// SPDX-License-Identifier: MIT
// place_to_wait.hpp: where a robot waits whose path is cut off, so that somebody can pass it.
#pragma once

#include <cstddef>
#include <vector>

#include "controllers/motion/costmap_view.hpp"
#include "controllers/motion/guide.hpp"

namespace dmrp::controllers::mpc {

// Whether the guide reaches a place beside the end of the path (two points or more). If that end lies on the obstacle,
// the way is not cut off.
bool leads_past(const Guide& guide, const CostmapView& map, const std::vector<Vec2>& points);

// What cuts off a planned path is not on the map: a robot or a person, who may come this way as fast as this robot, and
// who sees no more of it. If each of two stops within half of the distance, they do not touch. If each waits on its right
// of the path, they have left room to pass. `last`: the last point of the path that the guide reaches.
Vec2 place_to_wait(const Guide& guide, const CostmapView& map, const std::vector<Vec2>& points, std::size_t last);

}  // namespace dmrp::controllers::mpc
