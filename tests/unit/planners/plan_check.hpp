// SPDX-License-Identifier: MIT
// Checks a plan against its case from first principles. Shares nothing with the planners.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

inline std::optional<std::vector<CellXY>> cells_of(const PlanningCase& c, const std::vector<dmrp_waypoint>& path) {
  std::vector<CellXY> cells;
  for (const dmrp_waypoint& w : path) {
    const CellXY cell{static_cast<int>(std::floor((w.x - PlanningCase::origin.x) / PlanningCase::resolution_m)),
                      static_cast<int>(std::floor((w.y - PlanningCase::origin.y) / PlanningCase::resolution_m))};
    if (!c.is_free(cell) || std::hypot(w.x - c.center(cell).x, w.y - c.center(cell).y) > 1e-9) return std::nullopt;
    cells.push_back(cell);
  }
  return cells;
}

// What is wrong with one robot's path alone; empty if nothing is.
inline std::string check_path(const PlanningCase& c, const CaseRobot& robot, const std::vector<dmrp_waypoint>& path) {
  const auto cells = cells_of(c, path);
  if (path.empty() || !cells) return "no path on free cells' centers";
  if (!(cells->front() == robot.start)) return "begins elsewhere";
  if (robot.state != DMRP_ROBOT_ACTIVE)
    return path.size() == 1 && path[0].t_ns == PlanningCase::effective_from_ns ? "" : "a resting robot moves";
  std::size_t goal = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].t_ns != PlanningCase::effective_from_ns + static_cast<int64_t>(i) * PlanningCase::step_duration_ns)
      return "not one waypoint a step";
    if (!std::isnan(path[i].theta)) return "a heading";
    if (path[i].goal_index != 3 + goal) return "a wrong goal index";
    if (i > 0 && !((*cells)[i] == (*cells)[i - 1])) {
      const int dx = (*cells)[i].x - (*cells)[i - 1].x;
      const int dy = (*cells)[i].y - (*cells)[i - 1].y;
      if (std::abs(dx) + std::abs(dy) != 1) return "a jump";
      if (!c.is_open((*cells)[i - 1], (*cells)[i])) return "through a wall";
    }
    if (goal + 1 < robot.goals.size() && (*cells)[i] == robot.goals[goal]) ++goal;
  }
  if (goal + 1 != robot.goals.size()) return "a goal left out";
  if (!(cells->back() == robot.goals.back())) return "ends elsewhere";
  if (path.size() > 1 && cells->back() == (*cells)[path.size() - 2] &&
      (robot.goals.size() == 1 || path[path.size() - 2].goal_index == path.back().goal_index))
    return "waits at the end";
  return "";
}

// Vertex and swap conflicts of all pairs, robots resting where their paths end.
inline std::string check_conflicts(const PlanningCase& c, const Plan& plan) {
  std::vector<std::vector<CellXY>> cells;
  std::size_t steps = 0;
  for (const auto& path : plan.paths) {
    cells.push_back(*cells_of(c, path));
    steps = std::max(steps, path.size());
  }
  const auto at = [&](std::size_t robot, std::size_t t) { return cells[robot][std::min(t, cells[robot].size() - 1)]; };
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      for (std::size_t t = 0; t < steps; ++t) {
        if (at(a, t) == at(b, t)) return "vertex conflict";
        if (t > 0 && at(a, t) == at(b, t - 1) && at(b, t) == at(a, t - 1)) return "swap conflict";
      }
  return "";
}

inline std::string check_paths(const PlanningCase& c, const Plan& plan) {
  for (std::size_t i = 0; i < c.robots.size(); ++i) {
    const std::string problem = check_path(c, c.robots[i], plan.paths[i]);
    if (!problem.empty()) return "robot " + std::to_string(i) + ": " + problem;
  }
  return "";
}

// For coordinated planners.
inline std::string check_plan(const PlanningCase& c, const Plan& plan) {
  const std::string problem = check_paths(c, plan);
  return problem.empty() ? check_conflicts(c, plan) : problem;
}

// Changes of direction of motion.
inline int turns_of(const std::vector<dmrp_waypoint>& path) {
  int turns = 0;
  int heading = 0;  // none; else a code of (sign dx, sign dy)
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto sign = [](double d) { return d > 1e-9 ? 1 : d < -1e-9 ? -1 : 0; };
    const int now = 3 * sign(path[i].x - path[i - 1].x) + sign(path[i].y - path[i - 1].y);
    if (now == 0) continue;
    if (heading != 0 && now != heading) ++turns;
    heading = now;
  }
  return turns;
}

}  // namespace dmrp::test
