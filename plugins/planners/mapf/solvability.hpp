// SPDX-License-Identifier: MIT
// solvability.hpp: sound proofs that a problem has no plan, for searches that would not end on such a problem.
#pragma once

#include <optional>
#include <string>

#include "planners/mapf/problem.hpp"
#include "planners/mapf/stop_signal.hpp"

namespace dmrp::planners {

// Why there is no plan, by tests that cost next to nothing: two robots share a start or a last goal, or robots in a
// corridor without any branch end in another order than they begin. All goals must be on the graph.
template <Direction connectivity>
std::optional<std::string> find_obvious_obstruction(const BasicProblem<connectivity>& problem);

// Why there is no plan, by visiting all joint positions of the robots in each connected part of the graph that has
// at most `state_limit` of them. Says nothing about larger parts; complete for smaller ones where moves can be undone.
template <Direction connectivity>
std::optional<std::string> find_joint_obstruction(const BasicProblem<connectivity>& problem, std::size_t state_limit,
                                                  StopSignal& stop);

}  // namespace dmrp::planners
