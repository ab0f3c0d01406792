// SPDX-License-Identifier: MIT
// fewest_turns.hpp: a lower bound of the remaining turns of a path.
#pragma once

#include "planners/mapf/grid_graph.hpp"

namespace dmrp::planners {

// The fewest turns from one location to another, ignoring walls and other robots, for a robot whose last move had
// direction `heading` (or no_direction).
inline std::int32_t fewest_turns(const GridGraph& graph, Location from, Location to, Direction heading) {
  const std::int32_t east = graph.column(to) - graph.column(from);
  const std::int32_t north = graph.row(to) - graph.row(from);
  if (heading == GridGraph::no_direction) return east != 0 && north != 0 ? 1 : 0;
  const bool runs_north = heading % 2 == 1;
  const std::int32_t along = runs_north ? north : east;
  const std::int32_t across = runs_north ? east : north;
  const bool is_behind = heading < 2 ? along < 0 : along > 0;
  return (is_behind ? 1 : 0) + (across != 0 ? 1 : 0);
}

}  // namespace dmrp::planners
