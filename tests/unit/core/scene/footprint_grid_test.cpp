// SPDX-License-Identifier: MIT
#include "core/scene/footprint_grid.hpp"

#include <catch2/catch.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polygon.hpp>

#include "core/scene/footprint.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace footprint_grid_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

RobotSettings transporter() {
  RobotSettings type;
  type.parts = {{{-0.6, -0.3}, {0.6, -0.3}, {0.6, 0.3}, {-0.6, 0.3}}};
  type.radius_m = circumscribed_radius(type.parts);
  return type;
}

// Two rooms joined by a corridor from x = 4 to 8 along the middle of the row of cells at y = 4.5.
Scenario rooms_and_corridor(double width_m) {
  Scenario scenario = empty_scenario(12, 9);
  scenario.shapes = {box("south", {4, 0}, {8, 4.5 - 0.5 * width_m}), box("north", {4, 4.5 + 0.5 * width_m}, {8, 9})};
  return scenario;
}

TEST_CASE("a long robot passes a corridor in which it cannot turn") {
  const auto geometry = geometry_of(rooms_and_corridor(0.9));
  const PlanningGrid grid = build_planning_grid(*geometry, 1.0, transporter(), 0.1);
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  const auto at = [&](int column) { return view.index({column, 4}); };
  for (int column = 4; column < 8; ++column) {
    CAPTURE(column);
    CHECK(view.free(at(column)));
    CHECK(view.edge(at(column), 0));
    CHECK(view.edge(at(column), 4));
    for (const int direction : {1, 2, 3, 5, 6, 7}) CHECK_FALSE(view.edge(at(column), direction));
  }
  CHECK(reachable_cells(grid, at(1))[at(10)]);
  // a disc around it does not fit
  const PlanningGrid round = build_planning_grid(*geometry, 1.0, transporter().radius_m, 0.1);
  CHECK_FALSE(reachable_cells(round, at(1))[at(10)]);
}

TEST_CASE("a corridor too narrow for the robot and its margin is closed") {
  const PlanningGrid grid = build_planning_grid(*geometry_of(rooms_and_corridor(0.75)), 1.0, transporter(), 0.1);
  const dmrp_grid c_grid = grid.view();
  const toolkit::GridView view(c_grid);
  CHECK_FALSE(view.free(view.index({5, 4})));
}

TEST_CASE("a square footprint in the open has the grid of the circle around it") {
  RobotSettings square;
  square.parts = {{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}}};
  square.radius_m = circumscribed_radius(square.parts);
  const auto geometry = geometry_of(empty_scenario(10, 10));
  const PlanningGrid grid = build_planning_grid(*geometry, 1.0, square, 0.0);
  const PlanningGrid round = build_planning_grid(*geometry, 1.0, square.radius_m, 0.0);
  CHECK(grid.free == round.free);
  CHECK(grid.edges == round.edges);
}

}  // namespace footprint_grid_test
