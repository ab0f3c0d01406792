// SPDX-License-Identifier: MIT
// symmetry_split.hpp: a way to part two agents that settles many of their conflicts at once.
#pragma once

#include <array>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"

namespace dmrp::planners {

// Two sets of constraints, of conflict.a and of conflict.b. Every two paths of the agents that satisfy the constraints
// they have by now and do not conflict satisfy all of at least one set. The paths at hand satisfy neither.
struct SymmetrySplit {
  std::array<std::vector<Constraint>, 2> constraints;
  std::array<bool, 2> raises_cost{};  // no path of the agent's least cost satisfies its set
};

}  // namespace dmrp::planners
