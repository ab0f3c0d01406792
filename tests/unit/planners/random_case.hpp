// SPDX-License-Identifier: MIT
// Random problems, and the comparison of two answers.
#pragma once

#include <string>
#include <vector>

#include "tests/unit/planners/planning_case.hpp"
#include "tests/unit/planners/random.hpp"

namespace dmrp::test {

inline CellXY random_free_cell(Random& random, const PlanningCase& c) {
  for (;;)
    if (const CellXY cell{random.below(c.width), random.below(c.height)}; c.is_free(cell)) return cell;
}

// Starts and last goals are distinct free cells. Some cases have no plan.
inline void add_random_robots(Random& random, PlanningCase& c, int count, bool with_tours, bool with_resting) {
  while (static_cast<int>(c.robots.size()) < count) {
    CaseRobot robot{random_free_cell(random, c), {}, DMRP_ROBOT_ACTIVE};
    if (with_resting && random.one_in(8)) robot.state = DMRP_ROBOT_FINISHED;
    const int goals = with_tours && random.one_in(4) ? 2 + random.below(2) : 1;
    for (int g = 0; g < goals; ++g) robot.goals.push_back(random_free_cell(random, c));
    bool distinct = true;
    for (const CaseRobot& other : c.robots)
      distinct = distinct && !(other.start == robot.start) && !(other.goals.back() == robot.goals.back());
    if (distinct) c.robots.push_back(robot);
  }
}

// 4x4 to 6x6 cells with obstacles and thin walls; 2 to `most_robots` robots, some with tours, some resting.
inline PlanningCase random_case(uint64_t seed, int most_robots = 3) {
  Random random(seed);
  const int width = 4 + random.below(3);
  const int height = 4 + random.below(3);
  const int obstacles_of_20 = random.below(7);
  std::vector<std::string> rows(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), '.'));
  for (auto& row : rows)
    for (char& c : row)
      if (random.below(20) < obstacles_of_20) c = '#';
  rows[0].replace(0, 4, "....");  // room for all
  rows[1].replace(0, 4, "....");
  PlanningCase c(rows);
  if (random.one_in(2))
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        if (x + 1 < width && random.one_in(6)) c.thin_wall({x, y}, {x + 1, y});
        if (y + 1 < height && random.one_in(6)) c.thin_wall({x, y}, {x, y + 1});
      }
  add_random_robots(random, c, 2 + random.below(most_robots - 1), true, true);
  return c;
}

inline bool same_bits(const Plan& a, const Plan& b) {
  if (a.status != b.status || a.statistics != b.statistics || a.paths.size() != b.paths.size()) return false;
  for (std::size_t i = 0; i < a.paths.size(); ++i) {
    if (a.paths[i].size() != b.paths[i].size()) return false;
    for (std::size_t k = 0; k < a.paths[i].size(); ++k) {
      const dmrp_waypoint& u = a.paths[i][k];
      const dmrp_waypoint& v = b.paths[i][k];
      if (u.x != v.x || u.y != v.y || u.t_ns != v.t_ns || u.goal_index != v.goal_index) return false;
    }
  }
  return true;
}

}  // namespace dmrp::test
