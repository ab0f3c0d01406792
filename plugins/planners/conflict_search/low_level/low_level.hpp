// SPDX-License-Identifier: MIT
// low_level.hpp: request and result of a low-level search. It plans a path for one agent under constraints, with few
// conflicts with the other agents and a cost within a factor of the least.
//
// Both implementations are focal searches (Pearl, Kim 1982; for CBS: Barer et al. 2014). OPEN is ordered by f, the
// least cost of a path through a node; FOCAL holds the nodes of OPEN within the bound, ordered by conflicts. With
// suboptimality 1 this is A* that breaks ties by conflicts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"
#include "planners/mapf/tour_table.hpp"

namespace dmrp::planners {

struct LowLevelRequest {
  const Agent& agent;
  const TourTable& table;
  const ConstraintTable& constraints;
  const ConflictTable& others;
  double suboptimality = 1;
  std::int32_t conflict_steps = 0;  // steps that a path may be longer to avoid one conflict; 0: any, within the bound
  std::int32_t lower_bound = 0;     // known lower bound of the cost under these constraints
};

struct LowLevelPath {
  std::vector<Location> locations;
  std::int32_t lower_bound = 0;  // no path under the constraints costs less; at least the request's
  std::int32_t conflicts = 0;
};

enum class LowLevelResult { found, none, stopped };

// The least cost of a path that is at a location at time t. `waited_at_end`: its last step was a wait at the end of the
// tour; the path should have ended before it, so it cannot end now.
inline std::int32_t least_cost_by_way_of(const LowLevelRequest& request, std::int32_t leg, Location location,
                                         std::int32_t t, bool waited_at_end) {
  std::int32_t rest = request.table.distance(leg, location);
  const std::int32_t finish_from = request.constraints.finish_from();
  if (rest == 0 && (waited_at_end || t < finish_from)) rest = 2;  // away and back
  std::int32_t cost = std::max(t + rest, finish_from);
  if (request.agent.last_leg() > 0) return cost;
  for (const ConstraintTable::Landmark& landmark : request.constraints.landmarks())
    // an agent that rests at its goal also satisfies a landmark there
    if (landmark.t >= t && landmark.location != request.agent.last_goal())
      cost = std::max(cost, landmark.t + request.table.distance(0, landmark.location));
  return cost;
}

inline bool may_end(const LowLevelRequest& request, std::int32_t leg, Location location, std::int32_t t) {
  return location == request.agent.last_goal() && leg == request.agent.last_leg() &&
         t >= request.constraints.finish_from() && t <= request.constraints.finish_until();
}

// The order within FOCAL, as one number: fewest conflicts, then least f (with conflict_steps: least f plus that many
// steps for each conflict, then fewest conflicts); then nearest to the end; then fewest turns. Each part saturates.
inline std::uint64_t focal_order(std::int32_t conflicts, std::int32_t conflict_steps, std::int32_t f_above_least,
                                 std::int32_t rest, std::int32_t turns) {
  const auto part = [](std::int64_t value, int bits, int shift) {
    const std::int64_t most = (std::int64_t{1} << bits) - 1;
    return static_cast<std::uint64_t>(std::min(value, most)) << shift;
  };
  const std::int64_t first = conflict_steps > 0 ? std::int64_t{conflicts} * conflict_steps + f_above_least : conflicts;
  const std::int64_t second = conflict_steps > 0 ? conflicts : f_above_least;
  return part(first, 16, 48) | part(second, 16, 32) | part(rest, 18, 14) | part(turns, 14, 0);
}

}  // namespace dmrp::planners
