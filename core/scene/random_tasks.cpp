// SPDX-License-Identifier: MIT
#include "core/scene/random_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <utility>

namespace dmrp::core {
namespace {

constexpr int attempts = 16;  // with other random numbers, while there is not room for all

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
  TaskSampler(std::span<const TypeGrid> grids, std::span<const std::vector<std::uint32_t>> parts, std::uint64_t seed,
              int attempt)
      : grids_(grids), start_is_taken_(grids[0].grid->free.size()), goal_is_taken_(start_is_taken_.size()) {
    for (const std::vector<std::uint32_t>& cells : parts) {
      starts_.push_back(shuffled(cells, toolkit::Stream(seed, "robots.starts", attempt)));
      goals_.push_back(shuffled(cells, toolkit::Stream(seed, "robots.goals", attempt)));
    }
    for (const TypeGrid& grid : grids) largest_m_ = std::max(largest_m_, grid.radius_m);
  }

  // Adds the next robot's task, unless there is no room.
  TaskLack add_to(std::vector<RobotTask>& tasks, std::size_t kind) {
    const dmrp_grid c_grid = grids_[kind].grid->view();
    const toolkit::GridView grid(c_grid);
    const auto& starts = starts_[kind];
    const auto& goals = goals_[kind];
    const auto start =
        std::find_if(starts.begin(), starts.end(), [&](std::uint32_t cell) { return !start_is_taken_[cell]; });
    if (start == starts.end()) return TaskLack::start;
    const dmrp_vec2 from = grid.center(*start);
    const auto is_left = [&](std::uint32_t cell) { return !goal_is_taken_[cell]; };
    const auto goal = std::find_if(goals.begin(), goals.end(), [&](std::uint32_t cell) {
      return is_left(cell) && toolkit::distance(grid.center(cell), from) >= min_task_length_m;
    });
    if (goal == goals.end())
      return std::any_of(goals.begin(), goals.end(), is_left) ? TaskLack::length : TaskLack::goal;
    const dmrp_vec2 to = grid.center(*goal);
    const double apart_m = std::max(task_separation_m, grids_[kind].radius_m + largest_m_ + task_gap_m);
    take(grid, *start, apart_m, start_is_taken_);
    take(grid, *goal, apart_m, goal_is_taken_);
    tasks.push_back({"robot " + std::to_string(tasks.size()),
                     {from.x, from.y, free_heading},
                     {{to.x, to.y, free_heading}},
                     grids_[kind].type});
    return TaskLack::nothing;
  }

 private:
  static std::vector<std::uint32_t> shuffled(std::vector<std::uint32_t> cells, toolkit::Stream stream) {
    for (std::size_t i = cells.size(); i > 1; --i) std::swap(cells[i - 1], cells[stream.below(i)]);
    return cells;
  }

  // Marks the cell and all cells too near to it.
  static void take(const toolkit::GridView& grid, std::uint32_t cell, double apart_m, std::vector<bool>& taken) {
    const toolkit::Cell middle = grid.cell(cell);
    const int reach = static_cast<int>(std::floor(apart_m / grid.resolution_m()));
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const toolkit::Cell other = {middle.column + dx, middle.row + dy};
        if (grid.contains(other) && grid.resolution_m() * std::hypot(dx, dy) <= apart_m)
          taken[grid.index(other)] = true;
      }
  }

  std::span<const TypeGrid> grids_;
  double largest_m_ = 0.0;
  std::vector<std::vector<std::uint32_t>> starts_;  // by grid
  std::vector<std::vector<std::uint32_t>> goals_;
  std::vector<bool> start_is_taken_;
  std::vector<bool> goal_is_taken_;
};

std::size_t grid_of(std::span<const TypeGrid> grids, const std::string& type) {
  const auto found = std::find_if(grids.begin(), grids.end(), [&](const TypeGrid& grid) { return grid.type == type; });
  return static_cast<std::size_t>(found - grids.begin());
}

// The cells that the open edge of a map reaches over cells of such clearance.
std::vector<bool> wide_outside(const PlanningGrid& grid, double clearance_m) {
  std::vector<bool> narrow(grid.free.size());
  for (std::size_t cell = 0; cell < narrow.size(); ++cell)
    narrow[cell] = static_cast<double>(grid.clearance[cell]) < clearance_m;
  std::vector<bool> outside(narrow.size());
  for (std::uint32_t cell = 0; cell < grid.at_open_edge.size(); ++cell) {
    if (!grid.at_open_edge[cell] || !grid.free[cell] || narrow[cell] || outside[cell]) continue;
    const std::vector<bool> seen = reachable_cells(grid, cell, narrow);
    for (std::size_t other = 0; other < seen.size(); ++other) outside[other] = outside[other] || seen[other];
  }
  return outside;
}

// Adds what lies within `steps` moves, between the wide outside and the walls; diagonal ones reach into corners.
void widen(const dmrp_grid& grid, int steps, std::vector<bool>& cells) {
  const toolkit::GridView view(grid);
  for (int step = 0; step < steps; ++step) {
    const std::vector<bool> before = cells;
    for (std::uint32_t cell = 0; cell < view.size(); ++cell)
      for (int direction = 0; before[cell] && direction < toolkit::direction_count; ++direction)
        if (view.edge(cell, direction)) cells[view.neighbour(cell, direction)] = true;
  }
}

// The outside of the buildings of a map whose edge is open; empty if there is none, or if no point lies in a building.
std::vector<bool> outside_of_buildings(const PlanningGrid& grid, const std::vector<bool>& holds_point) {
  constexpr double half_way_m = way_outside_m / 2.0;
  if (grid.at_open_edge.empty()) return {};
  std::vector<bool> outside = wide_outside(grid, half_way_m);
  widen(grid.view(), static_cast<int>(half_way_m / grid.resolution_m), outside);
  for (std::size_t cell = 0; cell < outside.size(); ++cell)
    if (holds_point[cell] && grid.free[cell] && !outside[cell]) return outside;
  return {};
}

}  // namespace

std::vector<std::uint32_t> part_for_tasks(const PlanningGrid& grid, std::span<const dmrp_vec2> inside) {
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  std::vector<bool> holds_point(view.size());
  for (const dmrp_vec2 point : inside)
    if (const toolkit::Cell cell = view.cell_of(point); view.contains(cell)) holds_point[view.index(cell)] = true;

  const std::vector<bool> outside = outside_of_buildings(grid, holds_point);
  std::vector<bool> known = outside.empty() ? std::vector<bool>(view.size()) : outside;
  std::vector<std::uint32_t> best;  // the first among equals
  bool best_is_inside = false;
  for (std::uint32_t cell = 0; cell < view.size(); ++cell) {
    if (!view.free(cell) || known[cell]) continue;
    const std::vector<bool> seen = reachable_cells(grid, cell, outside);
    std::vector<std::uint32_t> part;
    bool is_inside = false;
    for (std::uint32_t other = cell; other < seen.size(); ++other) {
      if (!seen[other]) continue;
      part.push_back(other);
      known[other] = true;
      is_inside = is_inside || holds_point[other];
    }
    if (is_inside < best_is_inside || (is_inside == best_is_inside && part.size() <= best.size())) continue;
    best = std::move(part);
    best_is_inside = is_inside;
  }
  return best;
}

std::vector<std::string> drawn_types(std::span<const TypeShare> shares, std::size_t count) {
  if (shares.empty()) return std::vector<std::string>(count);
  double sum = 0.0;
  for (const TypeShare& share : shares) sum += share.share;
  std::vector<double> given(shares.size());
  std::vector<std::string> types;
  while (types.size() < count) {
    std::size_t most_missing = 0;
    const auto missing = [&](std::size_t i) {
      return shares[i].share / sum * static_cast<double>(types.size() + 1) - given[i];
    };
    for (std::size_t i = 1; i < shares.size(); ++i)
      if (missing(i) > missing(most_missing)) most_missing = i;
    given[most_missing] += 1.0;
    types.push_back(shares[most_missing].type);
  }
  return types;
}

std::vector<RobotTask> random_tasks(std::span<const TypeGrid> grids, std::span<const std::string> types,
                                    std::uint64_t seed, std::span<const dmrp_vec2> inside, TaskLack* lack) {
  std::vector<std::vector<std::uint32_t>> parts;
  for (const TypeGrid& grid : grids) parts.push_back(part_for_tasks(*grid.grid, inside));
  std::vector<RobotTask> most;
  for (int attempt = 0; attempt < attempts && (most.size() < types.size() || attempt == 0); ++attempt) {
    TaskSampler sampler(grids, parts, seed, attempt);
    std::vector<RobotTask> tasks;
    TaskLack lacks = TaskLack::nothing;
    while (tasks.size() < types.size() && lacks == TaskLack::nothing)
      lacks = sampler.add_to(tasks, grid_of(grids, types[tasks.size()]));
    if (attempt > 0 && tasks.size() <= most.size()) continue;
    most = std::move(tasks);
    if (lack) *lack = lacks;
  }
  return most;
}

std::vector<RobotTask> random_tasks(const PlanningGrid& grid, std::size_t count, std::uint64_t seed,
                                    std::span<const dmrp_vec2> inside, TaskLack* lack) {
  const TypeGrid only = {"", 0.0, &grid};
  return random_tasks({&only, 1}, std::vector<std::string>(count), seed, inside, lack);
}

bool has_room_for_tasks(const PlanningGrid& grid, std::size_t count, std::span<const dmrp_vec2> inside) {
  // Each previous task takes at most that many cells, and a robot's start those too near for its own goal.
  return part_for_tasks(grid, inside).size() >=
         count * cells_within(grid, task_separation_m) + cells_within(grid, min_task_length_m);
}

}  // namespace dmrp::core
