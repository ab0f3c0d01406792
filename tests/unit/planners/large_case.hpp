// SPDX-License-Identifier: MIT
// Random problems with many robots.
#pragma once

#include <string>
#include <vector>

#include "tests/unit/planners/planning_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace dmrp::test {

// Robots with distinct starts and distinct goals on free cells of the whole grid.
inline void scatter(PlanningCase& c, Random& random, int robots) {
  const auto draw = [&](auto is_taken) {
    for (;;) {
      const CellXY cell{random.below(c.width), random.below(c.height)};
      if (c.is_free(cell) && !is_taken(cell)) return cell;
    }
  };
  for (int i = 0; i < robots; ++i) {
    const auto among = [&](auto end_of) {
      return [&c, end_of](CellXY cell) {
        for (const CaseRobot& robot : c.robots)
          if (end_of(robot) == cell) return true;
        return false;
      };
    };
    const CellXY start = draw(among([](const CaseRobot& robot) { return robot.start; }));
    std::vector<CellXY> goals;
    if (random.one_in(5)) goals.push_back(draw([](CellXY) { return false; }));
    goals.push_back(draw(among([](const CaseRobot& robot) { return robot.goals.back(); })));
    c.robot(start, goals);
  }
}

// 24x18 cells with obstacles and thin walls.
inline PlanningCase large_case(uint64_t seed, int robots) {
  Random random(seed);
  std::vector<std::string> rows(18, std::string(24, '.'));
  for (auto& row : rows)
    for (char& cell : row)
      if (random.one_in(12)) cell = '#';
  rows[0].assign(24, '.');
  PlanningCase c(rows);
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x + 1 < 24; ++x)
      if (random.one_in(15)) c.thin_wall({x, y}, {x + 1, y});
  scatter(c, random, robots);
  return c;
}

}  // namespace dmrp::test
