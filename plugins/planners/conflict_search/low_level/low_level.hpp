// SPDX-License-Identifier: MIT
// low_level.hpp: what a low-level search is asked for and gives: a path for one agent under constraints, with few
// conflicts with the others, of a cost within a bound of the least.
//
// Both searches are focal searches (Pearl, Kim 1982; in this use Barer et al. 2014): OPEN by f, the least cost of a
// path through a node; FOCAL, the nodes of OPEN within the bound, by conflicts. With suboptimality 1 that is A* with
// ties broken by conflicts: a path of least cost, and of these one with fewest conflicts.
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
  std::int32_t conflict_steps = 0;  // steps that a path may be longer for a conflict less; 0: any, within the bound
  std::int32_t lower_bound = 0;     // of the agent's cost under these constraints, as far as it is known
};

struct LowLevelPath {
  std::vector<Location> locations;
  std::int32_t lower_bound = 0;  // no path under the constraints costs less; at least the request's
  std::int32_t conflicts = 0;
};

enum class LowLevelResult { found, none, stopped };

// The least cost of a path by way of a place at a time. `waited_at_end`: the last step was a wait where the path could
// have ended, so that it cannot end there now.
inline std::int32_t least_cost_by_way_of(const LowLevelRequest& request, std::int32_t leg, Location location,
                                         std::int32_t t, bool waited_at_end) {
  std::int32_t rest = request.table.distance(leg, location);
  const std::int32_t finish_from = request.constraints.finish_from();
  if (rest == 0 && (waited_at_end || t < finish_from)) rest = 2;  // away and back
  std::int32_t cost = std::max(t + rest, finish_from);
  if (request.agent.last_leg() > 0) return cost;
  for (const ConstraintTable::Landmark& landmark : request.constraints.landmarks())
    // a landmark at the goal may be kept by resting there from before
    if (landmark.t >= t && landmark.location != request.agent.last_goal())
      cost = std::max(cost, landmark.t + request.table.distance(0, landmark.location));
  return cost;
}

inline bool may_end(const LowLevelRequest& request, std::int32_t leg, Location location, std::int32_t t) {
  return location == request.agent.last_goal() && leg == request.agent.last_leg() &&
         t >= request.constraints.finish_from() && t <= request.constraints.finish_until();
}

// The order within FOCAL: fewest conflicts first, then least f; or both together, a conflict counting as so many steps.
// Then nearest to the end, then fewest turns. What does not fit its part of the number ranks with the largest that
// does.
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
