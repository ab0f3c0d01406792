// SPDX-License-Identifier: MIT
// rectangle.hpp: rectangle symmetry (Li et al. 2019 and 2021): two agents cross each other on open ground, both moving
// in the directions of one quadrant, say east and north, without waits. Whichever of their shortest paths they take,
// they conflict.
//
// Let u and w be the coordinates along the two directions, zero at the conflict, which is at time t. An agent is in
// phase at a time s if u + w = s - t. While two agents are both in phase, every step takes each of them one further
// along u or w, so the difference of their u changes by at most one a step: if a is to the left of b (or they meet) at
// one time and to the right of it later, they meet in between. From this follow the barriers: nodes of a's MDD on a
// column u = R and up to a row w = Q, and nodes of b's MDD on the row w = Q and up to the column u = R. If a is on its
// barrier and b on its own, a has moved to the right of b. If all ways to the barriers in the MDDs have been in phase
// since a time at which all of a's were to the left of all of b's, one agent must avoid its whole barrier.
//
// This also holds for paths longer than those of the MDDs: an agent that reaches a node of its MDD came by a way in the
// MDD, because from there it could continue to the end at least cost. The last node is an exception: an agent can reach
// it by waiting at its goal until it may come to rest. Then the node is on no barrier.
#pragma once

#include <optional>

#include "planners/conflict_search/low_level/mdd.hpp"
#include "planners/conflict_search/symmetry/symmetry_split.hpp"

namespace dmrp::planners {

// For a vertex conflict. The MDDs are of the agents' least costs; the paths may cost more. Nothing if the conflict is
// of another kind, if an agent has more than one goal, or if the barriers contain only the conflict itself.
std::optional<SymmetrySplit> find_rectangle(const GridGraph& graph, const Conflict& conflict, const Mdd& mdd_a,
                                            const Mdd& mdd_b, PathView path_a, PathView path_b);

}  // namespace dmrp::planners
