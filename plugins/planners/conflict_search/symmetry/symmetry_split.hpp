// SPDX-License-Identifier: MIT
// symmetry_split.hpp: a split that resolves many conflicts of two agents at once.
#pragma once

#include <array>
#include <vector>

#include "planners/conflict_search/low_level/conflict_table.hpp"
#include "planners/conflict_search/low_level/constraint.hpp"

namespace dmrp::planners {

// Two sets of constraints, on conflict.a and on conflict.b. Any two paths that satisfy the agents' present constraints
// and do not conflict satisfy one of the sets. The current paths satisfy neither.
struct SymmetrySplit {
  std::array<std::vector<Constraint>, 2> constraints;
  std::array<bool, 2> raises_cost{};  // whether no path of the agent's least cost satisfies its set
};

}  // namespace dmrp::planners
