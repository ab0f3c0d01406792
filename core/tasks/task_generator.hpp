// SPDX-License-Identifier: MIT
// task_generator.hpp: draws the robots' tasks of a trial, as random as random_tasks.hpp has them, or as difficult as
// wished.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/scene/planning_grids.hpp"
#include "core/scene/random_tasks.hpp"
#include "core/scene/scenario.hpp"
#include "core/tasks/task_difficulty.hpp"

namespace dmrp::core {

enum class Crossing { any, corridor };  // which conflicts count: all, or those on cells with one lane

inline constexpr std::uint32_t any_number = std::numeric_limits<std::uint32_t>::max();

struct TaskWishes {
  std::uint32_t drawn = 0;  // so many sets of tasks; 0: each repetition has its own, without further wishes
  std::uint32_t conflicts_min = 0;
  std::uint32_t conflicts_max = any_number;
  Crossing crossing = Crossing::any;
};

struct TaskRequest {
  std::size_t count = 0;         // robots
  std::vector<TypeShare> types;  // none: all of the default type
  std::vector<dmrp_vec2> inside;
  TaskWishes wishes;
};

struct DrawnTasks {
  std::vector<RobotTask> tasks;  // fewer than asked for if there is not room for all
  TaskDifficulty difficulty;     // of tasks with wishes
  bool as_wished = true;
  TaskLack lack = TaskLack::nothing;  // why there are fewer
};

// With wishes it draws until the tasks are well-formed and have as many conflicts as wished, at most
// `task_attempts` times; then `as_wished` is false. The first draw is that without wishes: wishes that it fulfils change
// nothing.
inline constexpr int task_attempts = 1000;
DrawnTasks draw_tasks(const PlanningGrids& grids, const TaskRequest& request, std::uint64_t seed);

}  // namespace dmrp::core
