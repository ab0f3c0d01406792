// SPDX-License-Identifier: MIT
#include "core/tasks/task_difficulty.hpp"

#include <algorithm>
#include <dmrp/toolkit/grid_view.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace dmrp::core {
namespace {

using CellPath = std::vector<std::uint32_t>;
using toolkit::GridView;

constexpr std::uint32_t unreachable = std::numeric_limits<std::uint32_t>::max();
constexpr int straight = 2;  // every second of the eight directions is one

// The number of straight moves from each cell to the goal, over cells that are not closed.
std::vector<std::uint32_t> steps_to(const GridView& grid, std::uint32_t goal, const std::vector<bool>& closed) {
  std::vector<std::uint32_t> steps(grid.size(), unreachable);
  std::vector<std::uint32_t> queue = {goal};
  steps[goal] = 0;
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (int direction = 0; direction < toolkit::direction_count; direction += straight) {
      if (!grid.edge(queue[next], direction)) continue;
      const std::uint32_t other = grid.neighbour(queue[next], direction);
      if (steps[other] != unreachable || closed[other]) continue;
      steps[other] = steps[queue[next]] + 1;
      queue.push_back(other);
    }
  return steps;
}

// The shortest path that keeps its direction as long as it can.
CellPath individual_path(const GridView& grid, std::uint32_t start, const std::vector<std::uint32_t>& steps) {
  CellPath path = {start};
  int heading = 0;
  while (steps[path.back()] != unreachable && steps[path.back()] > 0) {
    const auto leads_on = [&](int direction) {
      return grid.edge(path.back(), direction) &&
             steps[grid.neighbour(path.back(), direction)] + 1 == steps[path.back()];
    };
    for (int turn = 0; turn < toolkit::direction_count && !leads_on(heading); turn += straight)
      heading = (heading + straight) % toolkit::direction_count;
    path.push_back(grid.neighbour(path.back(), heading));
  }
  return path;
}

std::uint32_t at_step(const CellPath& path, std::size_t step) {
  return path[std::min(step, path.size() - 1)];
}

// Two parallel sides of the cell are closed.
bool has_one_lane(const GridView& grid, std::uint32_t cell) {
  constexpr int across = 2 * straight;
  const auto closed = [&](int direction) {
    return !grid.edge(cell, direction) && !grid.edge(cell, direction + across);
  };
  return closed(0) || closed(straight);
}

struct Meeting {
  bool conflicts = false;
  bool in_corridor = false;
};

Meeting meeting_of(const GridView& grid, const CellPath& a, const CellPath& b) {
  Meeting out;
  for (std::size_t step = 0; step < std::max(a.size(), b.size()); ++step) {
    const std::uint32_t cell_a = at_step(a, step);
    const std::uint32_t cell_b = at_step(b, step);
    const bool same = cell_a == cell_b;
    const bool exchange = !same && cell_a == at_step(b, step + 1) && cell_b == at_step(a, step + 1);
    if (!same && !exchange) continue;
    out.conflicts = true;
    out.in_corridor = out.in_corridor || has_one_lane(grid, cell_a) || has_one_lane(grid, cell_b);
  }
  return out;
}

// The least number of steps between the passages of a cell that both paths have.
std::optional<std::uint32_t> slack_of(const CellPath& a, const CellPath& b) {
  std::optional<std::uint32_t> least;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (a[i] != b[j]) continue;
      const auto apart = static_cast<std::uint32_t>(i > j ? i - j : j - i);
      if (!least || apart < *least) least = apart;
    }
  return least;
}

}  // namespace

TaskDifficulty difficulty_of(const PlanningGrid& grid, std::span<const RobotTask> tasks) {
  const dmrp_grid c_grid = grid.view();
  const GridView view(c_grid);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const RobotTask& task : tasks)
    ends.emplace_back(view.index(view.cell_of({task.start.x, task.start.y})),
                      view.index(view.cell_of({task.goals.front().x, task.goals.front().y})));

  TaskDifficulty out;
  std::vector<CellPath> paths;
  for (std::size_t robot = 0; robot < ends.size(); ++robot) {
    const auto [start, goal] = ends[robot];
    std::vector<bool> closed(view.size());
    paths.push_back(individual_path(view, start, steps_to(view, goal, closed)));
    for (std::size_t other = 0; other < ends.size(); ++other)
      if (other != robot) closed[ends[other].first] = closed[ends[other].second] = true;
    out.well_formed = out.well_formed && !closed[goal] && steps_to(view, goal, closed)[start] != unreachable;
  }
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      const Meeting meeting = meeting_of(view, paths[a], paths[b]);
      out.conflicts += meeting.conflicts ? 1 : 0;
      out.corridor_conflicts += meeting.in_corridor ? 1 : 0;
      if (meeting.conflicts) continue;
      if (const auto slack = slack_of(paths[a], paths[b]); slack && (!out.slack_steps || *slack < *out.slack_steps))
        out.slack_steps = slack;
    }
  return out;
}

}  // namespace dmrp::core
