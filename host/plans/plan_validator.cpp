// SPDX-License-Identifier: MIT
#include "host/plans/plan_validator.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

namespace dmrp::host {

namespace {

constexpr double position_tolerance_m = 1e-6;

using Cell = PlanCell;

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
  return Cell{static_cast<std::int32_t>(c), static_cast<std::int32_t>(r)};
}

std::size_t index_of(const dmrp_grid& grid, Cell cell) {
  return static_cast<std::size_t>(cell.row) * grid.width + static_cast<std::size_t>(cell.column);
}

// "" if there is none.
struct Breach {
  std::string text{};
  std::size_t waypoint = 0;
};

std::string where(std::size_t robot, std::size_t waypoint) {
  return fmt::format("robot {}, waypoint {}", robot, waypoint);
}

// For every planner: waypoints are finite, begin at the start, have increasing times, and visit all goals in order; the
// path ends at the last goal, unless it is partial.
Breach check_structure(const dmrp_planning_problem& problem, const dmrp_planning_robot& robot, std::size_t index,
                       const std::vector<dmrp_waypoint>& path, bool partial) {
  if (path.empty()) return {fmt::format("robot {} has no waypoints", index)};
  if (partial && problem.window_steps == 0)
    return {fmt::format("robot {} has a partial path, but the whole way was asked for", index)};
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!std::isfinite(path[i].x) || !std::isfinite(path[i].y) || std::isinf(path[i].theta))
      return {where(index, i) + " is not finite", i};
    if (i > 0 && path[i].t_ns <= path[i - 1].t_ns) return {where(index, i) + ": times do not grow", i};
  }
  if (!near(path[0].x, path[0].y, robot.start.x, robot.start.y))
    return {fmt::format("robot {} begins at ({}, {}), not at its start ({}, {})", index, path[0].x, path[0].y,
                        robot.start.x, robot.start.y)};
  if (path[0].t_ns != problem.effective_from_ns)
    return {fmt::format("robot {} begins at {} ns, not when the plan takes effect ({} ns)", index, path[0].t_ns,
                        problem.effective_from_ns)};
  if (robot.state != DMRP_ROBOT_ACTIVE)
    return path.size() == 1 ? Breach() : Breach{fmt::format("robot {} is not active, but its path moves", index), 1};

  std::uint32_t heads_for = robot.first_goal_index;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const dmrp_waypoint& w = path[i];
    if (w.goal_index < heads_for) return {fmt::format("robot {} goes back to goal {}", index, w.goal_index), i};
    if (w.goal_index - robot.first_goal_index >= robot.goal_count)
      return {fmt::format("robot {} heads for goal {}, which it does not have", index, w.goal_index), i};
    heads_for = w.goal_index;
  }
  std::uint32_t reached = 0;
  for (std::size_t i = 0; i < path.size() && reached < robot.goal_count; ++i) {
    const dmrp_waypoint& w = path[i];
    const dmrp_goal& goal = *DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, reached);
    if (w.goal_index < robot.first_goal_index + reached)
      return {fmt::format("robot {} goes back to goal {}", index, w.goal_index), i};
    if (near(w.x, w.y, goal.pose.x, goal.pose.y) && w.goal_index == robot.first_goal_index + reached) ++reached;
  }
  const std::size_t last = path.size() - 1;
  if (partial) {
    // every goal before the one that it heads for
    if (heads_for > robot.first_goal_index + reached)
      return {fmt::format("robot {} does not visit its goal {}", index, robot.first_goal_index + reached), last};
    return {};
  }
  const dmrp_pose& goal = DMRP_AT(dmrp_goal, robot.goals, robot.goal_stride, robot.goal_count - 1)->pose;
  if (!near(path[last].x, path[last].y, goal.x, goal.y))
    return {fmt::format("robot {} ends at ({}, {}), not at its goal ({}, {})", index, path[last].x, path[last].y,
                        goal.x, goal.y),
            last};
  // the waypoint at a goal may already have the index of the next goal: only the order matters
  if (reached < robot.goal_count)
    return {fmt::format("robot {} does not visit its goal {}", index, robot.first_goal_index + reached), last};
  return {};
}

// For plans on the robot's grid: every move takes one step to an open neighbour. Fills in the cells, one per step.
Breach check_steps(const dmrp_planning_problem& problem, std::size_t index, const std::vector<dmrp_waypoint>& path,
                   std::uint32_t connectivity, std::vector<Cell>& cells) {
  const dmrp_grid& grid = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, index)->grid;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto cell = cell_at_center(grid, path[i]);
    if (!cell) return {where(index, i) + fmt::format(" ({}, {}) is not on a cell's centre", path[i].x, path[i].y), i};
    if (!grid.free[index_of(grid, *cell)])
      return {where(index, i) + fmt::format(" ({}, {}) is not on a free cell", path[i].x, path[i].y), i};
    if (i > 0) {
      const Cell from = cells.back();
      if (path[i].t_ns - path[i - 1].t_ns != problem.step_duration_ns)
        return {where(index, i) + ": a move does not take one step", i};
      const int dx = cell->column - from.column;
      const int dy = cell->row - from.row;
      if (std::abs(dx) > 1 || std::abs(dy) > 1 || (connectivity == DMRP_CONNECTIVITY_4 && dx != 0 && dy != 0))
        return {where(index, i) + ": the move is not one to a neighbour", i};
      if (dx != 0 || dy != 0) {
        static constexpr std::uint8_t bits[3][3] = {{DMRP_EDGE_SW, DMRP_EDGE_S, DMRP_EDGE_SE},
                                                    {DMRP_EDGE_W, 0, DMRP_EDGE_E},
                                                    {DMRP_EDGE_NW, DMRP_EDGE_N, DMRP_EDGE_NE}};
        if (!(grid.edges[index_of(grid, from)] & bits[dy + 1][dx + 1]))
          return {where(index, i) + fmt::format(": the move to ({}, {}) is not open", path[i].x, path[i].y), i};
      }
    }
    cells.push_back(*cell);
  }
  return {};
}

Breach check_sweeps(const dmrp_planning_robot& robot, std::size_t index, const std::vector<dmrp_waypoint>& path,
                    const SweepIsFree& sweep_is_free) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!sweep_is_free({path[i - 1].x, path[i - 1].y}, {path[i].x, path[i].y}, robot.robot->footprint->radius_m))
      return {where(index, i) + ": the motion meets a static shape", i};
  return {};
}

std::vector<double> radii_m(const dmrp_planning_problem& problem) {
  std::vector<double> radii;
  for (std::size_t i = 0; i < problem.robot_count; ++i)
    radii.push_back(DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i)->robot->footprint->radius_m);
  return radii;
}

std::vector<core::StepOverlaps::Robot> robots_of(const dmrp_planning_problem& problem) {
  std::vector<core::StepOverlaps::Robot> robots;
  for (std::size_t i = 0; i < problem.robot_count; ++i) {
    const auto& robot = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i);
    const dmrp_footprint& footprint = *robot.robot->footprint;
    robots.push_back({footprint.radius_m, {}, robot.grid, robot.state == DMRP_ROBOT_ACTIVE});
    for (std::uint32_t p = 0; p < footprint.part_count; ++p) {
      const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, p);
      robots.back().parts.emplace_back(part.vertices, part.vertices + part.vertex_count);
    }
  }
  return robots;
}

}  // namespace

PlanVerdict validate_plan(const dmrp_planning_problem& problem, const PlannedPaths& paths, std::uint32_t connectivity,
                          const SweepIsFree& sweep_is_free, const std::vector<bool>& partial) {
  PlanVerdict verdict;
  if (paths.size() != problem.robot_count) {
    verdict.error = fmt::format("{} paths for {} robots", paths.size(), problem.robot_count);
    verdict.robot = problem.robot_count;
    return verdict;
  }
  std::vector<std::vector<Cell>> cells(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& robot = *DMRP_AT(dmrp_planning_robot, problem.robots, problem.robot_stride, i);
    Breach breach = check_structure(problem, robot, i, paths[i], !partial.empty() && partial[i]);
    if (breach.text.empty())
      breach = connectivity == DMRP_CONNECTIVITY_ANY ? check_sweeps(robot, i, paths[i], sweep_is_free)
                                                     : check_steps(problem, i, paths[i], connectivity, cells[i]);
    if (!breach.text.empty()) return {std::move(breach.text), 0, "", i, breach.waypoint};
  }
  core::StepOverlaps overlaps(problem.grid->resolution_m, robots_of(problem));
  PlanConflicts conflicts = connectivity == DMRP_CONNECTIVITY_ANY ? find_disc_conflicts(paths, radii_m(problem))
                                                                  : find_step_conflicts(cells, overlaps);
  verdict.conflicts = conflicts.count;
  verdict.first_conflict = std::move(conflicts.first);
  verdict.robot = conflicts.robot;
  verdict.waypoint = conflicts.waypoint;
  return verdict;
}

}  // namespace dmrp::host
