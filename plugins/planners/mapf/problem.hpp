// SPDX-License-Identifier: MIT
// problem.hpp: the planning problem on the graph, and the way back from paths to waypoints.
#pragma once

#include <dmrp/plugin.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planners/mapf/grid_graph.hpp"

namespace dmrp::planners {

// A time after all others, with room for a few steps more.
constexpr std::int32_t forever = std::numeric_limits<std::int32_t>::max() / 2;

// An active robot. Its path visits the goals in order and rests at the last.
//
// A step of a path ticks off at most one goal, the current one, if it ends there: two equal goals in a row cost a
// wait. So the goal that a step leads to follows from the locations alone.
struct Agent {
  std::uint32_t robot = 0;  // index in the host's problem
  Location start = nowhere;
  std::vector<Location> goals;
  std::uint32_t first_goal_index = 0;

  std::int32_t last_leg() const { return static_cast<std::int32_t>(goals.size()) - 1; }
  Location goal(std::int32_t leg) const { return goals[static_cast<std::size_t>(leg)]; }
  Location last_goal() const { return goals.back(); }

  // The leg of the step after one that was on `leg` and ended at `location`.
  std::int32_t leg_after(std::int32_t leg, Location location) const {
    return leg < last_leg() && location == goal(leg) ? leg + 1 : leg;
  }
};

template <Direction connectivity>
struct BasicProblem {
  BasicGridGraph<connectivity> graph;
  std::vector<Agent> agents;
};

using Problem = BasicProblem<4>;

// Where a robot is by time: one location a step, from its start until it rests at its last goal for good.
using PathView = std::span<const Location>;

inline std::int32_t cost_of(PathView path) {
  return static_cast<std::int32_t>(path.size()) - 1;
}

// Robots that are not active rest where they are: their cells are taken out of the graph if `resting_robots_block`.
// Locations that are not on a free cell are nowhere.
template <Direction connectivity = 4>
BasicProblem<connectivity> make_problem(const PlanningProblem& problem, bool resting_robots_block);

// Hands the active robots' paths, in the order of problem.agents, and the resting robots' single waypoints to the host.
template <Direction connectivity>
void write_paths(const PlanningProblem& host_problem, const BasicProblem<connectivity>& problem,
                 const std::vector<PathView>& paths, PlanSink& sink);

// Number of changes of direction; waits in between do not count.
template <Direction connectivity>
std::int32_t count_turns(const BasicGridGraph<connectivity>& graph, PathView path);

}  // namespace dmrp::planners
