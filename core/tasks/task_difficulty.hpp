// SPDX-License-Identifier: MIT
// task_difficulty.hpp: how much the robots of a set of tasks get into each other's way, before anybody plans or drives.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// Every robot on a shortest path of its own by straight moves, a cell a step, that turns as late as it can; at its goal
// it rests. Two robots conflict if they are on one cell at one step, or exchange their cells.
struct TaskDifficulty {
  std::uint32_t conflicts = 0;           // pairs of robots that conflict
  std::uint32_t corridor_conflicts = 0;  // of these, pairs that do so on a cell with one lane: no way aside
  // The least number of steps between the passages of two robots that share a cell and do not conflict: so small a delay
  // makes a conflict. None if there are no such robots.
  std::optional<std::uint32_t> slack_steps;
  // Every robot has a way to its goal that no start and no goal of another one is on. Then the robots can drive one
  // after the other: the tasks have a solution (Cap, Novak, Kleiner, Selecky: Prioritized planning algorithms for
  // trajectory coordination of multiple mobile robots, 2015, well-formed infrastructures).
  bool well_formed = true;
};

// Of tasks whose goals can be reached on this grid. Of a tour it sees the way to the first goal.
TaskDifficulty difficulty_of(const PlanningGrid& grid, std::span<const RobotTask> tasks);

}  // namespace dmrp::core
