// SPDX-License-Identifier: MIT
// problem.hpp: the planning problem on the graph, and the conversion of paths to waypoints.
#pragma once

#include <algorithm>
#include <cassert>
#include <dmrp/plugin.hpp>
#include <limits>
#include <span>
#include <vector>

#include "planners/mapf/grid_graph.hpp"

namespace dmrp::planners {

// A time after all others. A few steps can be added without overflow.
constexpr std::int32_t forever = std::numeric_limits<std::int32_t>::max() / 2;

// An active robot. Its path visits the goals in order and rests at the last.
//
// A step that ends at the current goal reaches it, and only it: two equal goals in a row cost a wait. So the leg of a
// step follows from the locations alone.
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

// A robot's locations by time: one for each step, from its start until it rests at its last goal, or a window ends.
using PathView = std::span<const Location>;

inline std::int32_t cost_of(PathView path) {
  return static_cast<std::int32_t>(path.size()) - 1;
}

// An agent stays where its path ends.
inline Location location_at(PathView path, std::int32_t t) {
  assert(t >= 0 && !path.empty());
  return path[std::min(static_cast<std::size_t>(t), path.size() - 1)];
}

// Of paths or views of them.
template <typename Paths>
std::int64_t sum_of_costs(const Paths& paths) {
  std::int64_t sum = 0;
  for (const auto& path : paths) sum += cost_of(path);
  return sum;
}

// An active robot of the host's problem on a graph. Starts and goals that are not on a free cell become nowhere.
template <Direction connectivity>
Agent agent_on(const BasicGridGraph<connectivity>& graph, const PlanningRobot& robot, std::uint32_t number);

// All on the common grid. Robots that are not active rest where they are; with `resting_robots_block` their cells are removed from the graph.
template <Direction connectivity = 4>
BasicProblem<connectivity> make_problem(const PlanningProblem& problem, bool resting_robots_block);

// Gives the host the path of one active robot; partial if it does not end at its last goal.
template <Direction connectivity>
void write_path(const PlanningProblem& host_problem, const BasicGridGraph<connectivity>& graph, const Agent& agent,
                PathView path, PlanSink& sink);

// Gives the host one waypoint for each robot that is not active.
void write_resting_robots(const PlanningProblem& host_problem, PlanSink& sink);

// Gives the host the paths of the active robots, in the order of problem.agents, and one waypoint for each resting
// robot.
template <Direction connectivity>
void write_paths(const PlanningProblem& host_problem, const BasicProblem<connectivity>& problem,
                 const std::vector<PathView>& paths, PlanSink& sink);

// The number of changes of direction. Waits do not count.
template <Direction connectivity>
std::int32_t count_turns(const BasicGridGraph<connectivity>& graph, PathView path);

}  // namespace dmrp::planners
