// SPDX-License-Identifier: MIT
// robot_draw.hpp: tasks for any number of robots, drawn at random.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

inline constexpr double drawn_apart_m = 2.0;  // starts, and goals, are farther than this from each other
inline constexpr double drawn_way_m = 5.0;    // a goal is at least this far from its start, as the crow flies

// The cells that can be reached from one over open edges, orthogonal ones alone: what every planner can use.
std::vector<bool> reachable_cells(const PlanningGrid& grid, std::uint32_t from);

// Starts and goals of `count` robots on the centres of free cells, all of which can be reached from each other (the
// largest such part of the world); headings are free. Robot i is the same whatever `count` is, as long as there is room
// for all. Fewer than `count` where there is not.
//
// Each task is uniform among the cells that the ones before leave: so a set of tasks is a sampled instance of the world.
std::vector<RobotTask> draw_robots(const PlanningGrid& grid, std::size_t count, std::uint64_t seed);

// Whether draw_robots() finds room for so many, whatever the seed: true only if it does for sure.
bool surely_room_for(const PlanningGrid& grid, std::size_t count);

}  // namespace dmrp::core
