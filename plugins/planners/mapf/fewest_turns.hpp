// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include "grid_graph.hpp"
namespace dmrp::planners {
inline int sign(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

// Fewest turns from a location to another, walls aside, for a robot that came in direction `heading` (or none).
inline std::int32_t fewest_turns(const GridGraph& graph, Location from, Location to, Direction heading) {
  const dmrp_vec2 here = graph.center(from);
  const dmrp_vec2 there = graph.center(to);
  const std::array<int, 2> way = {sign(there.x - here.x), sign(there.y - here.y)};
  if (heading == GridGraph::no_direction) return way[0] != 0 && way[1] != 0 ? 1 : 0;
  const bool is_north_or_south = heading % 2 == 1;
  const int ahead = (heading < 2 ? 1 : -1) * way[is_north_or_south ? 1 : 0];
  const bool aside = way[is_north_or_south ? 0 : 1] != 0;
  return (ahead < 0 ? 1 : 0) + (aside ? 1 : 0);
}


}
