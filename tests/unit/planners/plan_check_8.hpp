// SPDX-License-Identifier: MIT
// Checks a plan with diagonals against its case from first principles. Shares nothing with the planners.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/planners/plan_check.hpp"

namespace dmrp::test {

// What is wrong with one robot's path alone; empty if nothing is.
inline std::string check_path_8(const PlanningCase& c, const CaseRobot& robot, const std::vector<dmrp_waypoint>& path) {
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
      const CellXY from = (*cells)[i - 1];
      const CellXY to = (*cells)[i];
      if (std::abs(to.x - from.x) > 1 || std::abs(to.y - from.y) > 1) return "a jump";
      if (!c.is_open(from, to)) return "through a wall";
      if (!c.is_free({from.x, to.y}) || !c.is_free({to.x, from.y})) return "cuts a corner";
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

// Whether two robots that go from a0 to a1 and from b0 to b1 in one step conflict, by where they are on the way: twice
// the coordinates, so that the middle of a step is a whole number.
inline bool steps_conflict(CellXY a0, CellXY a1, CellXY b0, CellXY b1) {
  if (a0 == b0 || a1 == b1) return true;
  const CellXY middle_a{a0.x + a1.x, a0.y + a1.y};
  const CellXY middle_b{b0.x + b1.x, b0.y + b1.y};
  if (middle_a == middle_b) return true;  // changing places, straight or diagonally, and crossing diagonals
  // The middle of a diagonal is the corner of four cells: nobody else may begin or end on any of them but the
  // diagonal's own end, which it has just left or not reached yet.
  const auto is_beside = [](CellXY from, CellXY to, CellXY other) {
    return from.x != to.x && from.y != to.y && !(other == from) && !(other == to) &&
           std::abs(2 * other.x - (from.x + to.x)) == 1 && std::abs(2 * other.y - (from.y + to.y)) == 1;
  };
  return is_beside(a0, a1, b0) || is_beside(a0, a1, b1) || is_beside(b0, b1, a0) || is_beside(b0, b1, a1);
}

// All pairs, robots resting where their paths end.
inline std::string check_conflicts_8(const PlanningCase& c, const Plan& plan) {
  std::vector<std::vector<CellXY>> cells;
  std::size_t steps = 0;
  for (const auto& path : plan.paths) {
    cells.push_back(*cells_of(c, path));
    steps = std::max(steps, path.size());
  }
  const auto at = [&](std::size_t robot, std::size_t t) { return cells[robot][std::min(t, cells[robot].size() - 1)]; };
  for (std::size_t a = 0; a < cells.size(); ++a)
    for (std::size_t b = a + 1; b < cells.size(); ++b)
      for (std::size_t t = 1; t <= steps; ++t)
        if (steps_conflict(at(a, t - 1), at(a, t), at(b, t - 1), at(b, t)))
          return "robots " + std::to_string(a) + " and " + std::to_string(b) + " conflict before step " +
                 std::to_string(t);
  return "";
}

inline std::string check_plan_8(const PlanningCase& c, const Plan& plan) {
  for (std::size_t i = 0; i < c.robots.size(); ++i) {
    const std::string problem = check_path_8(c, c.robots[i], plan.paths[i]);
    if (!problem.empty()) return "robot " + std::to_string(i) + ": " + problem;
  }
  return check_conflicts_8(c, plan);
}

// Straight steps and waits cost 1, diagonals the square root of two.
inline double cost_8(const Plan& plan) {
  double cost = 0;
  for (const auto& path : plan.paths)
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double distance = std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
      cost += distance < 1e-9 ? 1.0 : distance / PlanningCase::resolution_m;
    }
  return cost;
}

}  // namespace dmrp::test
