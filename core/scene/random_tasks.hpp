// SPDX-License-Identifier: MIT
// random_tasks.hpp: random tasks for any number of robots.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/scene/planning_grid.hpp"
#include "core/scene/robot_types.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

inline constexpr double task_separation_m = 2.0;  // starts, and goals, are farther than this from each other
inline constexpr double task_gap_m = 0.2;         // so are the circles around their footprints, if they are large
inline constexpr double min_task_length_m = 5.0;  // a goal is at least this far from its start, as the crow flies

// On a map with an open edge, a narrower way between that edge and a room is a door.
inline constexpr double way_outside_m = 2.0;

// The largest connected set of free cells, ascending. `inside`: only sets that hold the cell of one of these points
// count, if there is such a set; around a building on a map there can be more free cells than in it. If its doors stand
// open, the set ends there: the outside, which the map's open edge reaches by ways at least way_outside_m wide, is left
// out, unless all of the points lie in it.
std::vector<std::uint32_t> part_for_tasks(const PlanningGrid& grid, std::span<const dmrp_vec2> inside);

// What the next robot lacked where there was not room for all: a cell for its start or for its goal, away from those of
// the others, or one far enough from its start.
enum class TaskLack { nothing, start, goal, length };

// Starts and goals of `count` robots on the centres of free cells of part_for_tasks(); headings are free. The task of
// robot i does not depend on `count` as long as there is room for all. Returns fewer than `count` tasks if there is not.
//
// Each task is uniform among the cells that the previous tasks leave: a set of tasks is a sampled instance of the
// world.
std::vector<RobotTask> random_tasks(const PlanningGrid& grid, std::size_t count, std::uint64_t seed,
                                    std::span<const dmrp_vec2> inside = {}, TaskLack* lack = nullptr);

// A share of the drawn robots that have a type. Shares need not sum up to 1.
struct TypeShare {
  std::string type;
  double share = 1.0;
};

// The types of the first `count` drawn robots, in proportion to the shares at every number of robots.
std::vector<std::string> drawn_types(std::span<const TypeShare> shares, std::size_t count);

// The grid on which the tasks of a type are drawn.
struct TypeGrid {
  std::string type;
  double radius_m = 0.0;  // of the circle around its footprint
  const PlanningGrid* grid = nullptr;
};

// Random tasks of robots with these types, each on the grid of its type. The tasks are those above if there is one type
// and its robots are not large.
std::vector<RobotTask> random_tasks(std::span<const TypeGrid> grids, std::span<const std::string> types,
                                    std::uint64_t seed, std::span<const dmrp_vec2> inside = {},
                                    TaskLack* lack = nullptr);

// Whether random_tasks() finds room for `count` robots with every seed. A sufficient condition: false does not mean
// that some seed fails.
bool has_room_for_tasks(const PlanningGrid& grid, std::size_t count, std::span<const dmrp_vec2> inside = {});

}  // namespace dmrp::core
