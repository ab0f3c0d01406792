// SPDX-License-Identifier: MIT
// An anytime planner for robots whose goals may grow: the first call finds any plan, so that the robots may set off;
// every later call improves the plan in force while they drive, and never makes it more expensive.
//
// Prioritised planning, then large neighbourhood search with pairs: two robots lose their paths and get new ones in the
// other order; the plan is kept if it costs less. What it keeps between calls is which pair comes next.
#include <algorithm>
#include <cstdlib>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using dmrp::toolkit::GridView;
using dmrp::toolkit::no_cell;
using Cells = std::vector<std::uint32_t>;  // the cell at each step; the robot stays at the last

std::uint32_t cell_at(const Cells& path, std::size_t step) {
  return path[std::min(step, path.size() - 1)];
}

// A robot's task as cells.
struct Task {
  GridView grid;
  std::uint32_t start;
  Cells goals;  // none: it rests at its start
};

// Whether a robot may go from `from` at `step` to `to` at the next one, with the others on their paths.
bool passes(const std::vector<const Cells*>& others, std::size_t step, std::uint32_t from, std::uint32_t to) {
  return std::none_of(others.begin(), others.end(), [&](const Cells* other) {
    return cell_at(*other, step + 1) == to || (cell_at(*other, step + 1) == from && cell_at(*other, step) == to);
  });
}

// The fewest steps from each cell to the goal, over orthogonal moves.
std::vector<std::uint32_t> distances(const GridView& grid, std::uint32_t goal) {
  std::vector<std::uint32_t> steps(grid.size(), no_cell);
  Cells queue = {goal};
  steps[goal] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int direction = 0; direction < 8; direction += 2) {
      const std::uint32_t next = grid.neighbour(queue[i], direction);
      if (next == no_cell || !grid.edge(queue[i], direction) || steps[next] != no_cell) continue;
      steps[next] = steps[queue[i]] + 1;
      queue.push_back(next);
    }
  }
  return steps;
}

// Appends the shortest way from the end of `path` to the goal, by A* over cells and steps. A robot that stays at the
// goal arrives after the last of the others has passed it.
bool append_leg(const Task& task, std::uint32_t goal, bool stays, const std::vector<const Cells*>& others,
                Cells& path) {
  std::size_t last_step = 0;  // nothing moves after it
  std::size_t free_from = 0;  // the goal is free for good
  for (const Cells* other : others) {
    last_step = std::max(last_step, other->size());
    for (std::size_t step = 0; step < other->size(); ++step)
      if (cell_at(*other, step) == goal) free_from = std::max(free_from, step + 1);
    if (stays && other->back() == goal) return false;
  }
  const std::vector<std::uint32_t> ahead = distances(task.grid, goal);
  if (ahead[path.back()] == no_cell) return false;

  using Place = std::pair<std::uint32_t, std::size_t>;                // cell, step; steps after last_step are alike
  using Entry = std::tuple<std::size_t, std::size_t, std::uint32_t>;  // least steps in all, steps to go, cell
  std::map<Place, Place> came_from;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const std::size_t begin = path.size() - 1;
  open.emplace(begin + ahead[path.back()], ahead[path.back()], path.back());
  came_from[{path.back(), begin}] = {no_cell, 0};
  while (!open.empty()) {
    const auto [total, left, cell] = open.top();
    open.pop();
    const std::size_t step = total - left;
    if (cell == goal && (!stays || step >= free_from)) {
      Cells leg;
      for (Place at = {cell, step}; at.first != no_cell && leg.size() < step - begin;) {
        leg.push_back(at.first);
        at = {came_from.at({at.first, at.second}).first, at.second - 1};
      }
      path.insert(path.end(), leg.rbegin(), leg.rend());
      return true;
    }
    if (step > last_step + task.grid.size()) continue;
    for (int direction = -2; direction < 8; direction += 2) {  // -2: waits
      const std::uint32_t next = direction < 0 ? cell : task.grid.neighbour(cell, direction);
      if (next == no_cell || (direction >= 0 && !task.grid.edge(cell, direction)) || ahead[next] == no_cell) continue;
      if (!passes(others, step, cell, next) || !came_from.emplace(Place{next, step + 1}, Place{cell, step}).second)
        continue;
      open.emplace(step + 1 + ahead[next], ahead[next], next);
    }
  }
  return false;
}

std::optional<Cells> find_path(const Task& task, const std::vector<const Cells*>& others) {
  Cells path = {task.start};
  for (std::size_t i = 0; i < task.goals.size(); ++i)
    if (!append_leg(task, task.goals[i], i + 1 == task.goals.size(), others, path)) return std::nullopt;
  return path;
}

std::size_t cost_of(const std::vector<Cells>& plan) {
  std::size_t sum = 0;
  for (const Cells& path : plan) sum += path.size() - 1;
  return sum;
}

class AnytimePlanner final : public dmrp::GlobalPlanner {
 public:
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.anytime", "Anytime planner", "0.1.0").connectivity(DMRP_CONNECTIVITY_4);
  }
  dmrp::Param<int> attempts = param("attempts", 1).range(0, 1000).doc("pairs of robots that a later call tries");

  dmrp::Status start(const dmrp::Start&) override {
    next_pair_ = 0;
    return dmrp::Status::ok;
  }

  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    read_tasks(problem);
    std::optional<std::vector<Cells>> plan = rest_of_plan_in_force(problem);
    if (plan) {
      const std::string rest = std::to_string(cost_of(*plan));
      for (int i = 0; i < attempts && !should_stop(); ++i) try_next_pair(*plan);
      log(dmrp::LogLevel::info, "kept " + rest + " " + std::to_string(cost_of(*plan)));
    } else {
      plan = first_plan();
      log(dmrp::LogLevel::info, "planned anew");
    }
    if (!plan) return dmrp::Status::timeout;  // a plan may exist: prioritised planning is not complete
    for (std::size_t i = 0; i < plan->size(); ++i) write(problem, i, (*plan)[i], sink);
    sink.statistic("cost", static_cast<double>(cost_of(*plan)));
    return dmrp::Status::ok;
  }

 private:
  void read_tasks(const dmrp::PlanningProblem& problem) {
    tasks_.clear();
    for (const dmrp::PlanningRobot& robot : problem.robots) {
      Task task = {GridView(*robot.grid), GridView(*robot.grid).index_of(robot.start), {}};
      if (robot.state == DMRP_ROBOT_ACTIVE)
        for (const dmrp::Goal& goal : robot.goals())
          task.goals.push_back(task.grid.index_of(dmrp::Vec2{goal.pose.x, goal.pose.y}));
      tasks_.push_back(std::move(task));
    }
  }

  // The plan in force from where the robots are now; nothing if a robot has left it, or if it does not lead to all goals,
  // as when there are new ones, or if the robots' delays have made it collide.
  std::optional<std::vector<Cells>> rest_of_plan_in_force(const dmrp::PlanningProblem& problem) const {
    if (problem.in_force.empty()) return std::nullopt;
    std::vector<Cells> plan;
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      const Task& task = tasks_[i];
      Cells cells;
      if (task.goals.empty()) {
        cells = {task.start};
      } else {
        cells = rest_of(problem.in_force[i], task, problem.effective_from_ns);
        if (cells.empty() || !leads_to_goals(cells, task.goals)) return std::nullopt;
      }
      plan.push_back(std::move(cells));
    }
    return is_valid(plan) ? std::optional(plan) : std::nullopt;
  }

  // From the robot's cell on; where the path passes it several times, from the time nearest to now.
  static Cells rest_of(dmrp::Path path, const Task& task, std::int64_t now_ns) {
    Cells cells;
    std::size_t here = path.size();
    for (std::size_t i = 0; i < path.size(); ++i) {
      cells.push_back(task.grid.index_of(dmrp::Vec2{path[i].x, path[i].y}));
      const auto away = [&](std::size_t k) { return std::abs(path[k].t_ns - now_ns); };
      if (cells.back() == task.start && (here == path.size() || away(i) < away(here))) here = i;
    }
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(here));
    return cells;
  }

  static bool leads_to_goals(const Cells& path, const Cells& goals) {
    auto from = path.begin();
    for (const std::uint32_t goal : goals) {
      from = std::find(from, path.end(), goal);
      if (from == path.end()) return false;
    }
    return path.back() == goals.back();
  }

  static bool is_valid(const std::vector<Cells>& plan) {
    for (std::size_t i = 0; i < plan.size(); ++i)
      for (std::size_t step = 0; step < plan[i].size(); ++step) {
        if (!passes(others_of(plan, i), step, cell_at(plan[i], step), cell_at(plan[i], step + 1))) return false;
      }
    return true;
  }

  static std::vector<const Cells*> others_of(const std::vector<Cells>& plan, std::size_t robot) {
    std::vector<const Cells*> others;
    for (std::size_t i = 0; i < plan.size(); ++i)
      if (i != robot && !plan[i].empty()) others.push_back(&plan[i]);
    return others;
  }

  // Gives paths to robots without one, in this order.
  bool complete(std::vector<Cells>& plan, const std::vector<std::size_t>& order) const {
    return std::all_of(order.begin(), order.end(), [&](std::size_t robot) {
      const std::optional<Cells> path = find_path(tasks_[robot], others_of(plan, robot));
      if (path) plan[robot] = *path;
      return path.has_value();
    });
  }

  // Robots without a goal stand in the way from the beginning; of the others, each in turn goes first until it works.
  std::optional<std::vector<Cells>> first_plan() const {
    std::vector<std::size_t> order;
    std::vector<Cells> resting(tasks_.size());
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      if (tasks_[i].goals.empty()) {
        resting[i] = {tasks_[i].start};
      } else {
        order.push_back(i);
      }
    }
    for (std::size_t turn = 0; turn < std::max<std::size_t>(order.size(), 1); ++turn) {
      std::vector<Cells> plan = resting;
      if (complete(plan, order)) return plan;
      std::rotate(order.begin(), order.begin() + 1, order.end());
    }
    return std::nullopt;
  }

  void try_next_pair(std::vector<Cells>& plan) {
    const std::size_t count = plan.size();
    if (count < 2) return;
    const std::size_t first = next_pair_ / (count - 1) % count;
    const std::size_t second = (first + 1 + next_pair_ % (count - 1)) % count;
    ++next_pair_;
    if (tasks_[first].goals.empty() || tasks_[second].goals.empty()) return;
    std::vector<Cells> other = plan;
    other[first].clear();
    other[second].clear();
    if (complete(other, {second, first}) && cost_of(other) < cost_of(plan)) plan = std::move(other);
  }

  void write(const dmrp::PlanningProblem& problem, std::size_t robot, const Cells& path, dmrp::PlanSink& sink) const {
    const Task& task = tasks_[robot];
    std::vector<dmrp::Waypoint> waypoints;
    std::size_t reached = 0;  // of the task's goals
    for (std::size_t step = 0; step < path.size(); ++step) {
      const dmrp::Vec2 center = task.grid.center(path[step]);
      const std::size_t goal = std::min(reached, std::max<std::size_t>(task.goals.size(), 1) - 1);
      waypoints.push_back({center.x, center.y, std::numeric_limits<double>::quiet_NaN(),
                           problem.effective_from_ns + static_cast<std::int64_t>(step) * problem.step_duration_ns,
                           problem.robots[robot].first_goal_index + static_cast<std::uint32_t>(goal), 0});
      if (reached < task.goals.size() && path[step] == task.goals[reached]) ++reached;
    }
    sink.path(static_cast<std::uint32_t>(robot), waypoints);
  }

  std::vector<Task> tasks_;
  std::size_t next_pair_ = 0;
};

}  // namespace

DMRP_PLUGINS(AnytimePlanner)
