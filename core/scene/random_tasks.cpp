// SPDX-License-Identifier: MIT
#include "core/scene/random_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <string>
#include <utility>

namespace dmrp::core {
namespace {

constexpr int attempts = 16;  // with other random numbers, while there is not room for all

// The largest connected set of cells, ascending; the first among equals.
std::vector<std::uint32_t> largest_part(const PlanningGrid& grid) {
  std::vector<bool> known(grid.free.size());
  std::vector<std::uint32_t> largest;
  for (std::uint32_t cell = 0; cell < grid.free.size(); ++cell) {
    if (!grid.free[cell] || known[cell]) continue;
    const std::vector<bool> seen = reachable_cells(grid, cell);
    std::vector<std::uint32_t> part;
    for (std::uint32_t other = cell; other < seen.size(); ++other)
      if (seen[other]) part.push_back(other);
    for (const std::uint32_t other : part) known[other] = true;
    if (part.size() > largest.size()) largest = std::move(part);
  }
  return largest;
}

// The number of cells of an unbounded grid whose centres lie within a distance of one cell's centre, itself included.
std::size_t cells_within(const PlanningGrid& grid, double distance_m) {
  const int reach = static_cast<int>(std::floor(distance_m / grid.resolution_m));
  std::size_t count = 0;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (grid.resolution_m * std::hypot(dx, dy) <= distance_m) ++count;
  return count;
}

class TaskSampler {
 public:
  TaskSampler(const PlanningGrid& grid, const std::vector<std::uint32_t>& cells, std::uint64_t seed, int attempt)
      : grid_(grid.view()),
        starts_(shuffled(cells, toolkit::Stream(seed, "robots.starts", attempt))),
        goals_(shuffled(cells, toolkit::Stream(seed, "robots.goals", attempt))),
        start_is_taken_(grid.free.size()),
        goal_is_taken_(grid.free.size()) {}

  // Adds the next robot's task; false if there is no room.
  bool add_to(std::vector<RobotTask>& tasks) {
    const auto start =
        std::find_if(starts_.begin(), starts_.end(), [&](std::uint32_t cell) { return !start_is_taken_[cell]; });
    if (start == starts_.end()) return false;
    const dmrp_vec2 from = grid_.center(*start);
    const auto goal = std::find_if(goals_.begin(), goals_.end(), [&](std::uint32_t cell) {
      return !goal_is_taken_[cell] && toolkit::distance(grid_.center(cell), from) >= min_task_length_m;
    });
    if (goal == goals_.end()) return false;
    const dmrp_vec2 to = grid_.center(*goal);
    take(*start, start_is_taken_);
    take(*goal, goal_is_taken_);
    constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();
    tasks.push_back(
        {"robot " + std::to_string(tasks.size() + 1), {from.x, from.y, free_heading}, {{to.x, to.y, free_heading}}});
    return true;
  }

 private:
  static std::vector<std::uint32_t> shuffled(std::vector<std::uint32_t> cells, toolkit::Stream stream) {
    for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[stream.below(i)]);
    return cells;
  }

  // Marks the cell and all cells too near to it.
  void take(std::uint32_t cell, std::vector<bool>& taken) const {
    const toolkit::Cell middle = grid_.cell(cell);
    const int reach = static_cast<int>(std::floor(task_separation_m / grid_.resolution_m()));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const toolkit::Cell other = {middle.column + dx, middle.row + dy};
        if (grid_.contains(other) && grid_.resolution_m() * std::hypot(dx, dy) <= task_separation_m)
          taken[grid_.index(other)] = true;
      }
  }

  toolkit::GridView grid_;
  std::vector<std::uint32_t> starts_;
  std::vector<std::uint32_t> goals_;
  std::vector<bool> start_is_taken_;
  std::vector<bool> goal_is_taken_;
};

}  // namespace

std::vector<RobotTask> random_tasks(const PlanningGrid& grid, std::size_t count, std::uint64_t seed) {
  const std::vector<std::uint32_t> cells = largest_part(grid);
  std::vector<RobotTask> most;
  for (int attempt = 0; attempt < attempts && (most.size() < count || attempt == 0); ++attempt) {
    TaskSampler sampler(grid, cells, seed, attempt);
    std::vector<RobotTask> tasks;
    while (tasks.size() < count && sampler.add_to(tasks)) continue;
    if (attempt == 0 || tasks.size() > most.size()) most = std::move(tasks);
  }
  return most;
}

bool has_room_for_tasks(const PlanningGrid& grid, std::size_t count) {
  // Each previous task takes at most that many cells, and a robot's start those too near for its own goal.
  return largest_part(grid).size() >=
         count * cells_within(grid, task_separation_m) + cells_within(grid, min_task_length_m);
}

}  // namespace dmrp::core
