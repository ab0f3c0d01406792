// SPDX-License-Identifier: MIT
// path_check.hpp: validates a file of paths written by `dmrp-host plan --paths` against the map and the tasks. Shares
// no code with the host or the planners, so that it does not repeat their errors.
#pragma once

#include <string>

namespace dmrp::test {

struct PathVerdict {
  std::string error;           // of a single path, one line; empty if there is none
  long conflicts = 0;          // between agents: vertex, swap, crossing, passing
  std::string first_conflict;  // one line
  long straight = 0;           // moves and waits until all agents rest at their goals
  long diagonal = 0;           // moves
  long makespan = 0;           // steps until the last agent rests
  double cost() const;         // diagonals cost the square root of 2
};

// The first `agents` tasks of the file `tasks` on `map`, both MovingAI's; `connectivity` 4 or 8.
//
// A path leads from the agent's start at t = 0 to its goal, one line for each step. A step is a wait or a move to a
// free neighbor; diagonal only with connectivity 8, and only if both cells beside the diagonal are free. The path ends
// when the agent rests at its goal. Conflicts: two agents in one cell (agents rest at their goals); a swap; an agent on
// a cell beside another one's diagonal at its begin or end, which includes crossing diagonals.
PathVerdict check_paths(const std::string& map, const std::string& tasks, int agents, int connectivity,
                        const std::string& paths);

}  // namespace dmrp::test
