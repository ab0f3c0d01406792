// SPDX-License-Identifier: MIT
// The least sum of costs with diagonals, by the search of joint_optimum.hpp. Shares the rule of conflicts with
// plan_check_8.hpp and nothing with the planners.
#pragma once

#include <cmath>
#include <vector>

#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/plan_check_8.hpp"

namespace dmrp::test {

// Moves in eight directions; diagonals cost the square root of two.
struct EightDirections {
  using Cost = double;
  static constexpr Cost unreachable = 1e9;
  static constexpr Cost tolerance = 1e-9;

  static std::vector<CellXY> reach(CellXY c) {
    std::vector<CellXY> cells;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) cells.push_back({c.x + dx, c.y + dy});
    return cells;
  }
  static Cost step_cost(CellXY from, CellXY to) { return from.x != to.x && from.y != to.y ? std::sqrt(2.0) : 1.0; }
  static bool conflict(CellXY a0, CellXY a1, CellXY b0, CellXY b1) { return steps_conflict(a0, a1, b0, b1); }
};

using JointSearch8 = BasicJointSearch<EightDirections>;

}  // namespace dmrp::test
