// SPDX-License-Identifier: MIT
// path_check.hpp: judges a file of paths as `dmrp-host plan --paths` writes it, from the map and the tasks alone.
// Shares no line of code with the host or the planners, so that a mistake of theirs is not repeated here.
#pragma once

#include <string>

namespace dmrp::test {

struct PathVerdict {
  std::string error;           // of a path by itself, in one line; empty if there is none
  long conflicts = 0;          // between agents: vertex, swap, crossing, passing
  std::string first_conflict;  // in one line
  long straight = 0;           // moves and waits until all agents are at their goals for good
  long diagonal = 0;           // moves
  long makespan = 0;           // steps until the last one is there
  double cost() const;         // sqrt 2 a diagonal
};

// The first `agents` tasks of the file `tasks` on `map`, both MovingAI's; `connectivity` 4 or 8.
//
// A path: from its start at t = 0 to its goal, one line a step, to neighbouring free cells or nowhere; diagonally only
// with 8, and only where both cells beside the diagonal are free. It ends when the agent is at its goal for good.
// Conflicts: two agents at one place (an agent rests at its goal), or changing places, or with a diagonal: a third
// agent on a cell beside it at its beginning or end, which crossing diagonals are an instance of.
PathVerdict check_paths(const std::string& map, const std::string& tasks, int agents, int connectivity,
                        const std::string& paths);

}  // namespace dmrp::test
