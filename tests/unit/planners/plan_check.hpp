// SPDX-License-Identifier: MIT
// Checks a plan against its case from first principles. Shares no code with the planners.
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

// The error of a step between two different cells; empty if there is none.
using StepCheck = std::string (*)(const PlanningCase& c, CellXY from, CellXY to);

inline std::string check_step(const PlanningCase& c, CellXY from, CellXY to) {
  if (std::abs(to.x - from.x) + std::abs(to.y - from.y) != 1) return "a jump";
  return c.is_open(from, to) ? "" : "through a wall";
}

// The error of one robot's path alone; empty if there is none.
inline std::string check_path(const PlanningCase& c, const CaseRobot& robot, const std::vector<dmrp_waypoint>& path,
                              StepCheck check) {
  const auto cells = cells_of(c, path);
  if (path.empty() || !cells) return "no path on free cells' centers";
  if (!(cells->front() == robot.start)) return "begins elsewhere";
  if (robot.state != DMRP_ROBOT_ACTIVE)
    return path.size() == 1 && path[0].t_ns == PlanningCase::effective_from_ns ? "" : "a resting robot moves";
  std::size_t goal = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].t_ns != PlanningCase::effective_from_ns + static_cast<int64_t>(i) * PlanningCase::step_duration_ns)
      return "not one waypoint for each step";
    if (!std::isnan(path[i].theta)) return "a heading";
    if (path[i].goal_index != 3 + goal) return "a wrong goal index";
    if (i > 0 && !((*cells)[i] == (*cells)[i - 1])) {
      const std::string error = check(c, (*cells)[i - 1], (*cells)[i]);
      if (!error.empty()) return error;
    }
    if (goal + 1 < robot.goals.size() && (*cells)[i] == robot.goals[goal]) ++goal;
  }
  if (goal + 1 != robot.goals.size()) return "misses a goal";
  if (!(cells->back() == robot.goals.back())) return "ends elsewhere";
  if (path.size() > 1 && cells->back() == (*cells)[path.size() - 2] &&
      (robot.goals.size() == 1 || path[path.size() - 2].goal_index == path.back().goal_index))
    return "waits at the end";
  return "";
}

// The first error that check(a0, a1, b0, b1) finds in a step of two robots, which rest where their paths end.
template <class CheckSteps>
std::string check_pairs(const PlanningCase& c, const Plan& plan, CheckSteps check) {
  std::vector<std::vector<CellXY>> cells;
  std::size_t steps = 0;
  for (const auto& path : plan.paths) {
    cells.push_back(*cells_of(c, path));
    steps = std::max(steps, path.size());
  }
  const auto at = [&](std::size_t robot, std::size_t t) { return cells[robot][std::min(t, cells[robot].size() - 1)]; };
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      for (std::size_t t = 1; t <= steps; ++t) {
        const std::string error = check(at(a, t - 1), at(a, t), at(b, t - 1), at(b, t));
        if (error.empty()) continue;
        return "robots " + std::to_string(a) + " and " + std::to_string(b) + ", step " + std::to_string(t) + ": " +
               error;
      }
  return "";
}

inline std::string check_conflicts(const PlanningCase& c, const Plan& plan) {
  return check_pairs(c, plan, [](CellXY a0, CellXY a1, CellXY b0, CellXY b1) {
    if (a0 == b0 || a1 == b1) return "vertex conflict";
    return a0 == b1 && a1 == b0 ? "swap conflict" : "";
  });
}

inline std::string check_paths(const PlanningCase& c, const Plan& plan, StepCheck check = check_step) {
  for (std::size_t i = 0; i < c.robots.size(); ++i) {
    const std::string problem = check_path(c, c.robots[i], plan.paths[i], check);
    if (!problem.empty()) return "robot " + std::to_string(i) + ": " + problem;
  }
  return "";
}

// For coordinated planners.
inline std::string check_plan(const PlanningCase& c, const Plan& plan) {
  const std::string problem = check_paths(c, plan);
  return problem.empty() ? check_conflicts(c, plan) : problem;
}

// The number of changes of direction.
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
