// SPDX-License-Identifier: MIT
#include "host/trial/plan_validator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace dmrp::host {

namespace {

constexpr double position_tolerance_m = 1e-6;

struct Cell {
  int column = 0;
  int row = 0;
  bool operator==(const Cell&) const = default;
};

bool near(double x, double y, double goal_x, double goal_y) {
  return std::hypot(x - goal_x, y - goal_y) <= position_tolerance_m;
}

std::optional<Cell> cell_at_center(const dmrp_grid& grid, const dmrp_waypoint& w) {
  const double column = (w.x - grid.origin.x) / grid.resolution_m - 0.5;
  const double row = (w.y - grid.origin.y) / grid.resolution_m - 0.5;
  const double c = std::round(column);
  const double r = std::round(row);
  if (!(c >= 0 && r >= 0 && c < grid.width && r < grid.height)) return std::nullopt;
  if (std::hypot(column - c, row - r) * grid.resolution_m > position_tolerance_m) return std::nullopt;
  return Cell{static_cast<int>(c), static_cast<int>(r)};
}

std::size_t index_of(const dmrp_grid& grid, Cell cell) {
  return static_cast<std::size_t>(cell.row) * grid.width + static_cast<std::size_t>(cell.column);
}

std::string where(std::size_t robot, std::size_t waypoint) {
  return fmt::format("robot {}, waypoint {}", robot, waypoint);
}

// For every planner: waypoints are finite, begin at the start, have increasing times, and visit all goals in order; the
// path ends at the last goal.
std::string check_structure(const dmrp_planning_problem& problem, const dmrp_planning_robot& robot, std::size_t index,
                            const std::vector<dmrp_waypoint>& path) {
  if (path.empty()) return fmt::format("robot {} has no waypoints", index);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!std::isfinite(path[i].x) || !std::isfinite(path[i].y) || std::isinf(path[i].theta))
      return where(index, i) + " is not finite";
    if (i > 0 && path[i].t_ns <= path[i - 1].t_ns) return where(index, i) + ": times do not grow";
  }
  if (!near(path[0].x, path[0].y, robot.start.x, robot.start.y))
    return fmt::format("robot {} begins at ({}, {}), not at its start ({}, {})", index, path[0].x, path[0].y,
                       robot.start.x, robot.start.y);
  if (path[0].t_ns != problem.effective_from_ns)
    return fmt::format("robot {} begins at {} ns, not when the plan takes effect ({} ns)", index, path[0].t_ns,
                       problem.effective_from_ns);
  if (robot.state != DMRP_ROBOT_ACTIVE)
    return path.size() == 1 ? "" : fmt::format("robot {} is not active, but its path moves", index);

  std::uint32_t heads_for = robot.first_goal_index;
  for (const dmrp_waypoint& w : path) {
    if (w.goal_index < heads_for) return fmt::format("robot {} goes back to goal {}", index, w.goal_index);
    if (w.goal_index - robot.first_goal_index >= robot.goal_count)
      return fmt::format("robot {} heads for goal {}, which it does not have", index, w.goal_index);
    heads_for = w.goal_index;
  }
  std::uint32_t reached = 0;
  for (const dmrp_waypoint& w : path) {
    if (reached == robot.goal_count) break;
    const dmrp_goal& goal = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, reached);
    if (w.goal_index < robot.first_goal_index + reached)
      return fmt::format("robot {} goes back to goal {}", index, w.goal_index);
    if (near(w.x, w.y, goal.pose.x, goal.pose.y) && w.goal_index == robot.first_goal_index + reached) ++reached;
  }
  const dmrp_goal& last = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, robot.goal_count - 1);
  if (!near(path.back().x, path.back().y, last.pose.x, last.pose.y))
    return fmt::format("robot {} ends at ({}, {}), not at its goal ({}, {})", index, path.back().x, path.back().y,
                       last.pose.x, last.pose.y);
  // the waypoint at a goal may already have the index of the next goal: only the order matters
  if (reached < robot.goal_count)
    return fmt::format("robot {} does not visit its goal {}", index, robot.first_goal_index + reached);
  return "";
}

// For plans on the grid: every move takes one step to an open neighbour. Fills in the cells, one per step.
std::string check_steps(const dmrp_planning_problem& problem, std::size_t index, const std::vector<dmrp_waypoint>& path,
                        std::uint32_t connectivity, std::vector<Cell>& cells) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto cell = cell_at_center(*problem.grid, path[i]);
    if (!cell) return where(index, i) + fmt::format(" ({}, {}) is not on a cell's centre", path[i].x, path[i].y);
    if (!problem.grid->free[index_of(*problem.grid, *cell)])
      return where(index, i) + fmt::format(" ({}, {}) is not on a free cell", path[i].x, path[i].y);
    if (i > 0) {
      const Cell from = cells.back();
      if (path[i].t_ns - path[i - 1].t_ns != problem.step_duration_ns)
        return where(index, i) + ": a move does not take one step";
      const int dx = cell->column - from.column;
      const int dy = cell->row - from.row;
      if (std::abs(dx) > 1 || std::abs(dy) > 1 || (connectivity == DMRP_CONNECTIVITY_4 && dx != 0 && dy != 0))
        return where(index, i) + ": the move is not one to a neighbour";
      if (dx != 0 || dy != 0) {
        static constexpr std::uint8_t bits[3][3] = {{DMRP_EDGE_SW, DMRP_EDGE_S, DMRP_EDGE_SE},
                                                    {DMRP_EDGE_W, 0, DMRP_EDGE_E},
                                                    {DMRP_EDGE_NW, DMRP_EDGE_N, DMRP_EDGE_NE}};
        if (!(problem.grid->edges[index_of(*problem.grid, from)] & bits[dy + 1][dx + 1]))
          return where(index, i) + fmt::format(": the move to ({}, {}) is not open", path[i].x, path[i].y);
      }
    }
    cells.push_back(*cell);
  }
  return "";
}

Cell at(const std::vector<Cell>& cells, std::size_t step) {
  return cells[std::min(step, cells.size() - 1)];
}

// The conflict of two robots between `step` and the next one, or nullptr.
const char* conflict(Cell a0, Cell a1, Cell b0, Cell b1) {
  if (a1 == b1) return "vertex";
  if (a0 == b1 && a1 == b0) return "swap";
  const auto diagonal = [](Cell from, Cell to) { return from.column != to.column && from.row != to.row; };
  const auto passes = [&](Cell from, Cell to, Cell other) {
    return diagonal(from, to) && (other == Cell{from.column, to.row} || other == Cell{to.column, from.row});
  };
  const bool crossing = diagonal(a0, a1) && diagonal(b0, b1) && a0.column + a1.column == b0.column + b1.column &&
                        a0.row + a1.row == b0.row + b1.row;
  if (crossing) return "crossing";
  if (passes(a0, a1, b0) || passes(a0, a1, b1) || passes(b0, b1, a0) || passes(b0, b1, a1)) return "passing";
  return nullptr;
}

void note_conflict(PlanVerdict& verdict, const std::string& text) {
  if (verdict.conflicts++ == 0) verdict.first_conflict = text;
}

void count_step_conflicts(const std::vector<std::vector<Cell>>& cells, PlanVerdict& verdict) {
  std::size_t makespan = 0;
  for (const auto& path : cells) makespan = std::max(makespan, path.size());
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b) {
      if (at(cells[a], 0) == at(cells[b], 0))
        note_conflict(verdict, fmt::format("robots {} and {} share a start", a, b));
      for (std::size_t step = 0; step + 1 < makespan; ++step)
        if (const char* kind =
                conflict(at(cells[a], step), at(cells[a], step + 1), at(cells[b], step), at(cells[b], step + 1)))
          note_conflict(verdict, fmt::format("{} conflict of robots {} and {} at step {}", kind, a, b, step + 1));
    }
}

// A robot's position at a time: linear between waypoints, at the last one afterwards.
dmrp_vec2 position(const std::vector<dmrp_waypoint>& path, std::int64_t t_ns) {
  if (t_ns >= path.back().t_ns) return {path.back().x, path.back().y};
  const auto next = std::upper_bound(path.begin(), path.end(), t_ns,
                                     [](std::int64_t t, const dmrp_waypoint& w) { return t < w.t_ns; });
  if (next == path.begin()) return {next->x, next->y};
  const dmrp_waypoint& from = *(next - 1);
  const double share = static_cast<double>(t_ns - from.t_ns) / static_cast<double>(next->t_ns - from.t_ns);
  return {from.x + share * (next->x - from.x), from.y + share * (next->y - from.y)};
}

// The least distance of two points that move linearly over one interval.
double least_distance(dmrp_vec2 a0, dmrp_vec2 a1, dmrp_vec2 b0, dmrp_vec2 b1) {
  const dmrp_vec2 offset{a0.x - b0.x, a0.y - b0.y};
  const dmrp_vec2 change{a1.x - a0.x - b1.x + b0.x, a1.y - a0.y - b1.y + b0.y};
  const double square = change.x * change.x + change.y * change.y;
  const double share = square > 0 ? std::clamp(-(offset.x * change.x + offset.y * change.y) / square, 0.0, 1.0) : 0.0;
  return std::hypot(offset.x + share * change.x, offset.y + share * change.y);
}

void count_disc_conflicts(const dmrp_planning_problem& problem, const PlannedPaths& paths, PlanVerdict& verdict) {
  const auto radius = [&](std::size_t i) {
    return DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i)->robot->footprint->radius_m;
  };
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      std::vector<std::int64_t> times;
      for (const auto& w : paths[a]) times.push_back(w.t_ns);
      for (const auto& w : paths[b]) times.push_back(w.t_ns);
      std::sort(times.begin(), times.end());
      for (std::size_t i = 0; i < times.size(); ++i) {
        const std::int64_t from = times[i];
        const std::int64_t to = i + 1 < times.size() ? times[i + 1] : from;
        const double distance = least_distance(position(paths[a], from), position(paths[a], to),
                                               position(paths[b], from), position(paths[b], to));
        if (distance < radius(a) + radius(b) - position_tolerance_m)
          note_conflict(verdict, fmt::format("robots {} and {} come within {:.3f} m of each other at {:.2f} s", a, b,
                                             distance, static_cast<double>(from) * 1e-9));
      }
    }
}

std::string check_sweeps(const dmrp_planning_robot& robot, std::size_t index, const std::vector<dmrp_waypoint>& path,
                         const SweepIsFree& sweep_is_free) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!sweep_is_free({path[i - 1].x, path[i - 1].y}, {path[i].x, path[i].y}, robot.robot->footprint->radius_m))
      return where(index, i) + ": the motion meets a static shape";
  return "";
}

}  // namespace

PlanVerdict validate_plan(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity,
                          const SweepIsFree& sweep_is_free) {
  PlanVerdict verdict;
  if (paths.size() != problem.robot_count) {
    verdict.error = fmt::format("{} paths for {} robots", paths.size(), problem.robot_count);
    return verdict;
  }
  std::vector<std::vector<Cell>> cells(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& robot = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i);
    verdict.error = check_structure(problem, robot, i, paths[i]);
    if (verdict.error.empty())
      verdict.error = connectivity == DMRP_CONNECTIVITY_ANY ? check_sweeps(robot, i, paths[i], sweep_is_free)
                                                            : check_steps(problem, i, paths[i], connectivity, cells[i]);
    if (!verdict.error.empty()) return verdict;
  }
  if (connectivity == DMRP_CONNECTIVITY_ANY)
    count_disc_conflicts(problem, paths, verdict);
  else
    count_step_conflicts(cells, verdict);
  return verdict;
}

}  // namespace dmrp::host
