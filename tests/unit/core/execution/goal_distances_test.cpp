// SPDX-License-Identifier: MIT
#include "core/execution/goal_distances.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <limits>
#include <vector>

#include "core/scene/planning_grids.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace goal_distances_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;
using toolkit::Stream;

Scenario with_boxes(Stream& random) {
  Scenario scenario = empty_scenario(40, 30);
  for (int i = 0; i < 25; ++i) {
    const dmrp_vec2 lower = {random.uniform(1.0, 36.0), random.uniform(1.0, 26.0)};
    scenario.shapes.push_back(
        box("b", lower, {lower.x + random.uniform(0.5, 4.0), lower.y + random.uniform(0.5, 4.0)}));
  }
  return scenario;
}

// From every cell to the goal's cell, until no edge shortens a way.
std::vector<double> relaxed(const toolkit::GridView& grid, std::uint32_t goal_cell, double first_m) {
  std::vector<double> to_goal_m(grid.size(), std::numeric_limits<double>::infinity());
  to_goal_m[goal_cell] = first_m;
  for (bool changes = true; changes;) {
    changes = false;
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
      for (int d = 0; d < toolkit::direction_count; ++d) {
        if (!grid.free(cell) || !grid.edge(cell, d)) continue;
        const double way_m = to_goal_m[grid.neighbour(cell, d)] +
                             grid.resolution_m() * toolkit::direction_length[static_cast<std::size_t>(d)];
        if (way_m >= to_goal_m[cell] - 1e-9) continue;
        to_goal_m[cell] = way_m;
        changes = true;
      }
  }
  return to_goal_m;
}

TEST_CASE("whatever is asked first, the distances to a goal are those of the shortest ways") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Stream random(seed, "goal_distances");
    const auto geometry = geometry_of(with_boxes(random));
    const PlanningGrids grids(*geometry, RobotTypes(RobotSettings{}), {});
    const dmrp_grid view = grids.of(RobotSettings{}.type).view();
    const toolkit::GridView grid(view);
    const dmrp_vec2 goal = {random.uniform(1.0, 39.0), random.uniform(1.0, 29.0)};
    if (!grid.free(grid.cell_of(goal))) continue;
    const std::uint32_t goal_cell = grid.index_of(goal);
    const auto expected = relaxed(grid, goal_cell, toolkit::distance(goal, grid.center(goal_cell)));
    GoalDistances distances(grid, goal);
    for (int ask = 0; ask < 300; ++ask) {
      const auto cell = static_cast<std::uint32_t>(random.uniform(0.0, grid.size() - 0.5));
      if (!grid.free(cell)) continue;
      CAPTURE(seed, ask, cell);
      if (std::isinf(expected[cell])) {
        CHECK(std::isinf(distances.from(grid.center(cell))));
      } else {
        CHECK(distances.from(grid.center(cell)) <= expected[cell] + 1e-3);
        // straight to the goal from its own cell and those beside it
        CHECK(distances.from(grid.center(cell)) >=
              expected[cell] - 1.5 * grid.resolution_m() * (expected[cell] < 3.0) - 1e-3);
      }
    }
  }
}

TEST_CASE("a way that comes nearer gains what is driven, whatever its direction") {
  const auto geometry = geometry_of(empty_scenario(40, 30));
  const PlanningGrids grids(*geometry, RobotTypes(RobotSettings{}), {});
  const dmrp_grid view = grids.of(RobotSettings{}.type).view();
  for (double heading = 0.0; heading < 1.6; heading += 0.1) {
    const dmrp_vec2 goal = {5.0, 5.0};
    GoalDistances distances(toolkit::GridView(view), goal);
    const auto at = [&](double away_m) { return goal + away_m * dmrp_vec2{std::cos(heading), std::sin(heading)}; };
    for (double away_m = 20.0; away_m > 3.0; away_m -= 0.5) {
      CAPTURE(heading, away_m);
      const double gained_m = distances.from(at(away_m)) - distances.from(at(away_m - 2.0));
      CHECK(gained_m > 1.0);
      CHECK(gained_m < 3.0);
    }
  }
}

}  // namespace goal_distances_test
