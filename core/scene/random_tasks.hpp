// SPDX-License-Identifier: MIT
// random_tasks.hpp: random tasks for any number of robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

inline constexpr double task_separation_m = 2.0;  // starts, and goals, are farther than this from each other
inline constexpr double min_task_length_m = 5.0;  // a goal is at least this far from its start, as the crow flies

// Starts and goals of `count` robots on the centres of free cells of the largest connected part of the world; headings
// are free. The task of robot i does not depend on `count` as long as there is room for all. Returns fewer than `count`
// tasks if there is not.
//
// Each task is uniform among the cells that the previous tasks leave: a set of tasks is a sampled instance of the
// world.
std::vector<RobotTask> random_tasks(const PlanningGrid& grid, std::size_t count, std::uint64_t seed);

// Whether random_tasks() finds room for `count` robots with every seed. A sufficient condition: false does not mean
// that some seed fails.
bool has_room_for_tasks(const PlanningGrid& grid, std::size_t count);

}  // namespace dmrp::core
