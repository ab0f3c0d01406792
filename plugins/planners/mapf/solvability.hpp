// SPDX-License-Identifier: MIT
// solvability.hpp: proofs that a problem has no plan, for searches that do not terminate on such problems.
#pragma once

#include <optional>
#include <string>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// The reason why there is no plan, if cheap tests find one: two robots share a start or a last goal, or the last goals
// of robots in a corridor without a branch are in another order than their starts. All goals must be on the graph.
template <Direction connectivity>
std::optional<std::string> find_obvious_obstruction(const BasicProblem<connectivity>& problem);

// The reason why there is no plan, if a visit of all joint positions finds one. Skips connected parts of the graph with
// more than `state_limit` joint positions. Complete for the other parts if their moves are symmetric.
template <Direction connectivity>
std::optional<std::string> find_joint_obstruction(const BasicProblem<connectivity>& problem, std::size_t state_limit,
                                                  StopSignal& stop);

}  // namespace dmrp::planners
