// SPDX-License-Identifier: MIT
// A complete global planner: prioritized planning. The robots plan one after the other; each finds a shortest path in
// space and time around the paths before it. If one finds none, it moves to the front and all plan again.
// Copy it, rename it, replace plan().
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <limits>
#include <optional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace toolkit = dmrp::toolkit;

constexpr std::uint32_t unreachable = std::numeric_limits<std::uint32_t>::max();
constexpr int waits = -1;                           // a move of no direction
constexpr int moves[] = {waits, 0, 2, 4, 6};        // the directions of the toolkit: E, N, W, S
constexpr double touching_cells = 1.4142135623731;  // discs on neighbouring cells can touch below sqrt(2) cells

// One step of a path: the cell at its end, and the goal that it leads to, counted from the robot's remaining goals.
struct Step {
  std::uint32_t cell;
  std::uint32_t goal;
};
using Steps = std::vector<Step>;

// What one active robot has to do, on its own grid.
struct Task {
  std::uint32_t robot;
  toolkit::GridView grid;
  std::uint32_t start;
  std::vector<std::uint32_t> goals;                    // cells, in the order of the tour
  std::vector<std::vector<std::uint32_t>> steps_left;  // [goal][cell]: over this goal to the last one
};

class PrioritizedPlanner final : public dmrp::GlobalPlanner {
 public:
  // The id must stay the same in all versions. Begin it with a domain that you own; `dmrp.` is reserved.
  // connectivity() promises what the paths are made of, and the host checks each plan accordingly: here waits and
  // orthogonal moves between the centres of cells, one a step. DMRP_CONNECTIVITY_8 allows diagonal moves,
  // DMRP_CONNECTIVITY_ANY straight motions at any angle and speed. uncoordinated() is for planners that keep no robots
  // apart: then conflicts are counted, and no fault.
  static dmrp::Descriptor describe() {
    return dmrp::Descriptor("org.example.my_plugin", "Prioritized planning", "0.1.0")
        .vendor("Example")
        .license("MIT")
        .summary("robots plan one after the other, around the paths of those before them")
        .source("Erdmann, Lozano-Perez: On multiple moving objects, Algorithmica 2 (1987)")
        .connectivity(DMRP_CONNECTIVITY_4);
  }

  // The keys that an experiment file may set under `params`. The host checks names, types and ranges.
  dmrp::Param<int> orders = param("orders", 100).range(1, 1000000).doc("orders of the robots that it tries");

  // Called once for each plan of a trial: the first, and every replan. Use no clock, and no random numbers except from
  // the seed of start(): the same problem must give the same plan.
  dmrp::Status plan(const dmrp::PlanningProblem& problem, dmrp::PlanSink& sink) override {
    expanded_ = 0;
    if (robots_can_touch_across_cells(problem)) {
      set_error("this planner needs cells of at least 1.42 times the robots' diameter");
      return dmrp::Status::no_solution;  // a correct answer: `dmrp-host validate` shows the text
    }

    std::vector<Steps> paths(problem.robots.size());
    std::vector<Task> tasks;
    for (std::uint32_t i = 0; i < problem.robots.size(); ++i) {
      const dmrp::PlanningRobot& robot = problem.robots[i];
      paths[i] = {{toolkit::GridView(*robot.grid).index_of(robot.start), 0}};
      // A robot that has arrived or failed stands at its start: a path of one waypoint, an obstacle for the others.
      if (robot.state == DMRP_ROBOT_ACTIVE) tasks.push_back(task_of(robot, i));
    }
    for (const Task& task : tasks)
      if (task.steps_left[0][task.start] == unreachable) {
        set_error("robot " + std::to_string(task.robot) + " cannot reach its goal");
        return dmrp::Status::no_solution;
      }

    for (int order = 0; order < orders; ++order) {
      const std::size_t stuck = plan_in_order(tasks, paths);
      if (should_stop()) return dmrp::Status::timeout;
      if (stuck == tasks.size()) return give(problem, paths, sink);
      std::rotate(tasks.begin(), tasks.begin() + static_cast<std::ptrdiff_t>(stuck),
                  tasks.begin() + static_cast<std::ptrdiff_t>(stuck) + 1);
    }
    sink.statistic("low_level_expanded", static_cast<double>(expanded_));
    return dmrp::Status::timeout;  // its own limit; no_solution would claim that no plan exists
  }

 private:
  // Robots in different cells can touch if cells are small: then equal cells are not the only conflict.
  static bool robots_can_touch_across_cells(const dmrp::PlanningProblem& problem) {
    double largest_m = 0.0;
    for (const dmrp::PlanningRobot& robot : problem.robots)
      largest_m = std::max(largest_m, robot.robot->footprint->radius_m);
    return problem.robots.size() > 1 && problem.grid.resolution_m < touching_cells * 2.0 * largest_m;
  }

  static Task task_of(const dmrp::PlanningRobot& robot, std::uint32_t index) {
    Task task = {index, toolkit::GridView(*robot.grid), 0, {}, {}};  // free cells and edges for this robot's footprint
    task.start = task.grid.index_of(robot.start);
    // A tour has several goals; those that the robot has reached are gone. Their poses lie at the centres of cells, and
    // `theta` is NaN where any heading will do.
    for (const dmrp::Goal& goal : robot.goals())
      task.goals.push_back(task.grid.index_of(dmrp::Vec2{goal.pose.x, goal.pose.y}));
    task.steps_left.resize(task.goals.size());
    std::uint32_t rest = 0;
    for (std::size_t goal = task.goals.size(); goal-- > 0;) {
      task.steps_left[goal] = steps_to(task.grid, task.goals[goal], rest);
      rest = task.steps_left[goal][goal > 0 ? task.goals[goal - 1] : task.start];
    }
    return task;
  }

  // The number of steps from each cell to `goal`, plus `rest`: breadth-first.
  static std::vector<std::uint32_t> steps_to(const toolkit::GridView& grid, std::uint32_t goal, std::uint32_t rest) {
    std::vector<std::uint32_t> steps(grid.size(), unreachable);
    if (rest == unreachable) return steps;
    steps[goal] = rest;
    std::vector<std::uint32_t> queue = {goal};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const int direction : {0, 2, 4, 6}) {
        const std::uint32_t from = queue[next];
        if (!grid.edge(from, direction)) continue;  // edges are mutual
        const std::uint32_t to = grid.neighbour(from, direction);
        if (steps[to] != unreachable) continue;
        steps[to] = steps[from] + 1;
        queue.push_back(to);
      }
    return steps;
  }

  // Plans all tasks in their order. The index of the first that finds no path; tasks.size() if all have one.
  std::size_t plan_in_order(const std::vector<Task>& tasks, std::vector<Steps>& paths) {
    std::vector<std::uint32_t> planned;  // robots whose paths stand: at first those that do not move
    for (std::uint32_t robot = 0; robot < paths.size(); ++robot)
      if (std::none_of(tasks.begin(), tasks.end(), [&](const Task& task) { return task.robot == robot; }))
        planned.push_back(robot);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      std::optional<Steps> path = shortest_path(tasks[i], planned, paths);
      if (!path) return i;
      paths[tasks[i].robot] = std::move(*path);
      planned.push_back(tasks[i].robot);
    }
    return tasks.size();
  }

  struct Node {
    std::uint32_t time;  // steps since the plan takes effect
    std::uint32_t cell;
    std::uint32_t goal;  // the next one; goals.size() when all are reached and the robot can stay
    std::size_t parent;
  };

  // A* over cells, goals and time; waits cost as much as moves. Empty if there is no path, or no time left.
  std::optional<Steps> shortest_path(const Task& task, const std::vector<std::uint32_t>& planned,
                                     const std::vector<Steps>& paths) {
    std::size_t still = 0;  // from this time on, the planned robots rest at their goals
    for (const std::uint32_t robot : planned) still = std::max(still, paths[robot].size());
    const auto at = [&](std::uint32_t robot, std::size_t time) {
      return paths[robot][std::min(time, paths[robot].size() - 1)].cell;
    };
    const auto is_blocked = [&](std::uint32_t from, std::uint32_t to, std::size_t time) {
      return std::any_of(planned.begin(), planned.end(), [&](std::uint32_t robot) {
        const std::uint32_t other = at(robot, time);
        return other == to || (other == from && at(robot, time - 1) == to);  // the same cell, or a swap
      });
    };
    const auto can_stay = [&](std::uint32_t cell, std::size_t time) {
      for (; time <= still; ++time)
        if (is_blocked(cell, cell, time + 1)) return false;
      return true;
    };
    const auto goal_after = [&](std::uint32_t cell, std::uint32_t goal, std::size_t time) {
      if (cell != task.goals[goal]) return goal;
      return goal + 1 < task.goals.size() || can_stay(cell, time) ? goal + 1 : goal;
    };

    std::vector<Node> nodes;
    // First the shortest estimated path, then the later time, then the older node: a total order, so that every
    // library's queue gives the same paths.
    using Entry = std::pair<std::pair<std::uint32_t, std::uint32_t>, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto add = [&](const Node& node) {
      const std::uint32_t left = node.goal < task.goals.size() ? task.steps_left[node.goal][node.cell] : 0;
      if (left == unreachable) return;
      open.push({{node.time + left, unreachable - node.time}, nodes.size()});
      nodes.push_back(node);
    };
    const std::size_t times = still + 2;
    std::vector<bool> is_closed(times * task.goals.size() * task.grid.size());

    add({0, task.start, goal_after(task.start, 0, 0), 0});
    while (!open.empty() && !should_stop()) {
      const std::size_t index = open.top().second;
      open.pop();
      const Node node = nodes[index];
      if (node.goal == task.goals.size()) return steps_of(nodes, index);
      const std::size_t time = std::min<std::size_t>(node.time, times - 1);
      const std::size_t state = (time * task.goals.size() + node.goal) * task.grid.size() + node.cell;
      if (is_closed[state]) continue;
      is_closed[state] = true;
      ++expanded_;
      for (const int move : moves) {
        if (move != waits && !task.grid.edge(node.cell, move)) continue;
        const std::uint32_t to = move == waits ? node.cell : task.grid.neighbour(node.cell, move);
        if (is_blocked(node.cell, to, node.time + 1)) continue;
        add({node.time + 1, to, goal_after(to, node.goal, node.time + 1), index});
      }
    }
    return std::nullopt;
  }

  // The cells from the start to this node. A waypoint belongs to the goal that the robot was heading for before it.
  static Steps steps_of(const std::vector<Node>& nodes, std::size_t last) {
    Steps steps;
    for (std::size_t i = last;; i = nodes[i].parent) {
      steps.push_back({nodes[i].cell, i == 0 ? 0 : nodes[nodes[i].parent].goal});
      if (i == 0) break;
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

  dmrp::Status give(const dmrp::PlanningProblem& problem, const std::vector<Steps>& paths, dmrp::PlanSink& sink) {
    std::size_t cost = 0;
    for (std::uint32_t robot = 0; robot < paths.size(); ++robot) {
      sink.path(robot, waypoints_of(problem, problem.robots[robot], paths[robot]));
      cost += paths[robot].size() - 1;
    }
    sink.statistic("cost", static_cast<double>(cost));
    sink.statistic("low_level_expanded", static_cast<double>(expanded_));
    return dmrp::Status::ok;
  }

  // The first waypoint is the robot's start, at the moment when the plan takes effect; one more follows for each step,
  // also for a wait, which repeats its cell. After the last waypoint the robot stays.
  static std::vector<dmrp::Waypoint> waypoints_of(const dmrp::PlanningProblem& problem,
                                                  const dmrp::PlanningRobot& robot, const Steps& steps) {
    const toolkit::GridView grid(*robot.grid);
    std::vector<dmrp::Waypoint> waypoints;
    for (const Step& step : steps) {
      const dmrp::Vec2 at = grid.center(step.cell);
      const std::int64_t t_ns =
          problem.effective_from_ns + static_cast<std::int64_t>(waypoints.size()) * problem.step_duration_ns;
      waypoints.push_back(dmrp::waypoint(at.x, at.y, t_ns, robot.first_goal_index + step.goal));
    }
    return waypoints;
  }

  std::uint64_t expanded_ = 0;  // in this call of plan()
};

}  // namespace

// All plugin classes of the library; once per library.
DMRP_PLUGINS(PrioritizedPlanner)
