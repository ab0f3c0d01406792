// SPDX-License-Identifier: MIT
// A planner that gives each robot its own shortest way on its own grid: a narrow robot takes a door through which a wide
// one does not fit.
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <limits>
#include <vector>

namespace {

using dmrp::toolkit::GridView;
using dmrp::toolkit::no_cell;

// The cells from `from` to `to`, both included, by orthogonal moves; empty if there is no way.
std::vector<std::uint32_t> shortest_way(const GridView& grid, std::uint32_t from, std::uint32_t to) {
  std::vector<std::uint32_t> next(grid.size(), no_cell);  // towards `to`
  std::vector<std::uint32_t> queue = {to};
  next[to] = to;
  for (std::size_t i = 0; i < queue.size() && next[from] == no_cell; ++i) {
    for (int direction = 0; direction < 8; direction += 2) {
      const std::uint32_t cell = grid.neighbour(queue[i], direction);
      if (cell == no_cell || !grid.edge(queue[i], direction) || next[cell] != no_cell) continue;
      next[cell] = queue[i];
      queue.push_back(cell);
    }
  }
  if (next[from] == no_cell) return {};
  std::vector<std::uint32_t> way = {from};
  while (way.back() != to) way.push_back(next[way.back()]);
  return way;
}

class GridOfEach final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.grid_of_each", "Grid of each", "0.1.0")
        .connectivity(DMRP_CONNECTIVITY_4)
        .uncoordinated();
  }

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      const dmrp::PlanningRobot& robot = problem.robots[i];
      const GridView grid(*robot.grid);
      std::vector<std::uint32_t> cells = {grid.index_of(robot.start)};
      std::vector<std::uint32_t> goal_of = {robot.first_goal_index};
      const dmrp::Span<dmrp::Goal> goals = robot.state == DMRP_ROBOT_ACTIVE ? robot.goals() : dmrp::Span<dmrp::Goal>();
      for (std::uint32_t k = 0; k < goals.size(); ++k) {
        const dmrp::Vec2 goal = {goals[k].pose.x, goals[k].pose.y};
        const std::vector<std::uint32_t> way = shortest_way(grid, cells.back(), grid.index_of(goal));
        if (way.empty()) return dmrp::Status::no_solution;
        cells.insert(cells.end(), way.begin() + 1, way.end());
        goal_of.resize(cells.size(), robot.first_goal_index + k);
      }
      write(problem, i, grid, cells, goal_of, sink);
    }
    return dmrp::Status::ok;
  }

 private:
  static void write(const dmrp::PlanningProblem& problem, std::uint32_t robot, const GridView& grid,
                    const std::vector<std::uint32_t>& cells, const std::vector<std::uint32_t>& goal_of,
                    dmrp::PlanSink& sink) {
    std::vector<dmrp::Waypoint> path;
    for (std::size_t step = 0; step < cells.size(); ++step) {
      const dmrp::Vec2 center = grid.center(cells[step]);
      path.push_back({center.x, center.y, std::numeric_limits<double>::quiet_NaN(),
                      problem.effective_from_ns + static_cast<std::int64_t>(step) * problem.step_duration_ns,
                      goal_of[step], 0});
    }
    sink.path(robot, path);
  }
};

}  // namespace

DMRP_PLUGINS(GridOfEach)
