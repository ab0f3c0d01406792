// SPDX-License-Identifier: MIT
// Checks a plan with diagonals against its case from first principles. Shares no code with the planners.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/planners/plan_check.hpp"

namespace dmrp::test {

inline std::string check_step_8(const PlanningCase& c, CellXY from, CellXY to) {
  if (std::abs(to.x - from.x) > 1 || std::abs(to.y - from.y) > 1) return "a jump";
  if (!c.is_open(from, to)) return "through a wall";
  return c.is_free({from.x, to.y}) && c.is_free({to.x, from.y}) ? "" : "cuts a corner";
}

// Whether two robots that move from a0 to a1 and from b0 to b1 in one step conflict. Compares positions in doubled
// coordinates, so that the middle of a step is an integer.
inline bool steps_conflict(CellXY a0, CellXY a1, CellXY b0, CellXY b1) {
  if (a0 == b0 || a1 == b1) return true;
  const CellXY middle_a{a0.x + a1.x, a0.y + a1.y};
  const CellXY middle_b{b0.x + b1.x, b0.y + b1.y};
  if (middle_a == middle_b) return true;  // swaps, straight or diagonal, and crossing diagonals
  // The middle of a diagonal is the corner of four cells. No other robot may begin or end on them, except on the
  // diagonal's own ends, which its robot has just left or not reached yet.
  const auto is_beside = [](CellXY from, CellXY to, CellXY other) {
    return from.x != to.x && from.y != to.y && !(other == from) && !(other == to) &&
           std::abs(2 * other.x - (from.x + to.x)) == 1 && std::abs(2 * other.y - (from.y + to.y)) == 1;
  };
  return is_beside(a0, a1, b0) || is_beside(a0, a1, b1) || is_beside(b0, b1, a0) || is_beside(b0, b1, a1);
}

inline std::string check_plan_8(const PlanningCase& c, const Plan& plan) {
  const std::string problem = check_paths(c, plan, check_step_8);
  if (!problem.empty()) return problem;
  return check_pairs(c, plan, [](CellXY a0, CellXY a1, CellXY b0, CellXY b1) {
    return steps_conflict(a0, a1, b0, b1) ? "conflict" : "";
  });
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
