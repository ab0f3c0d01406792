// SPDX-License-Identifier: MIT
// rectangle.hpp: two agents that cross each other on open ground, both in the directions of one quadrant, say east and
// north, without a wait: whichever of their many best paths they take, they meet (rectangle symmetry, Li et al. 2019
// and 2021).
//
// Let u and w be the coordinates along the two directions, zero at the conflict, which is at time t. An agent is in
// phase at a time s if u + w = s - t. While two agents are both in phase, every step takes each of them one further
// along u or w, so that the difference of their u changes by at most one a step: if a is to the left of b (or they
// meet) at one time and to the right of it later, they meet in between. Hence the barriers: nodes of a's MDD on a
// column u = R and up to a row w = Q, and nodes of b's MDD on the row w = Q and up to the column u = R. Where a is on
// its barrier and b on its own, a has come to the right of b. If all ways to the barriers in the MDDs have been in
// phase since a time when all of a's were to the left of all of b's, one agent has to stay off its whole barrier.
//
// That holds for paths longer than those of the MDDs too: whoever reaches a node of its MDD came by a way in the MDD,
// as it could go on to the end at least cost from there. (The last node alone may be reached otherwise: by waiting at
// the goal where that is too early to come to rest. Then it is on no barrier.)
#pragma once

#include <optional>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/symmetry_split.hpp"

namespace dmrp::planners {

// For a vertex conflict and the MDDs of the agents' least costs; the paths may cost more. Nothing if the conflict is
// of another kind, if an agent has more than one goal, or if the barriers are no more than the conflict itself.
std::optional<SymmetrySplit> find_rectangle(const GridGraph& graph, const Conflict& conflict, const Mdd& mdd_a,
                                            const Mdd& mdd_b, PathView path_a, PathView path_b);

}  // namespace dmrp::planners
