// SPDX-License-Identifier: MIT
#include "core/tasks/task_difficulty.hpp"

#include <algorithm>
#include <cassert>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/individual_path.hpp>
#include <utility>
#include <vector>

namespace dmrp::core {
namespace {

using toolkit::CellPath;
using toolkit::GridView;

// Two parallel sides of the cell are closed.
bool has_one_lane(const GridView& grid, std::uint32_t cell) {
  constexpr int across = 2 * toolkit::straight_stride;
  const auto closed = [&](int direction) {
    return !grid.edge(cell, direction) && !grid.edge(cell, direction + across);
  };
  return closed(0) || closed(toolkit::straight_stride);
}

struct Meeting {
  bool conflicts = false;
  bool in_corridor = false;
};

Meeting meeting_of(const GridView& grid, const CellPath& a, const CellPath& b) {
  Meeting out;
  toolkit::for_each_conflict(a, b, [&](std::uint32_t cell_a, std::uint32_t cell_b) {
    out.conflicts = true;
    out.in_corridor = out.in_corridor || has_one_lane(grid, cell_a) || has_one_lane(grid, cell_b);
  });
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
  assert(std::none_of(tasks.begin(), tasks.end(), [](const RobotTask& task) { return task.goals.empty(); }));
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
    paths.push_back(toolkit::individual_path(view, start, toolkit::straight_steps_to(view, goal, closed)));
    for (std::size_t other = 0; other < ends.size(); ++other)
      if (other != robot) closed[ends[other].first] = closed[ends[other].second] = true;
    out.well_formed =
        out.well_formed && !closed[goal] && toolkit::straight_steps_to(view, goal, closed)[start] != toolkit::no_way;
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
