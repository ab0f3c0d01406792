// SPDX-License-Identifier: MIT
#include "core/scene/planning_grid.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/shape_distance.hpp>

#include "core/scene/static_geometry.hpp"
#include "core/scene/world_view.hpp"
#include "core/trace/trace_reader.hpp"
#include "tests/unit/core/sample_scenarios.hpp"
#include "tests/unit/core/scene/sampled_clearance.hpp"
#include "tests/unit/core/trace/trace_in_memory.hpp"

namespace planning_grid_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;
using toolkit::Cell;
using toolkit::GridView;

TEST_CASE("cells and edges follow clearance and sweeps") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scenario scenario = random_scenario(seed, 12.0, 16);
    scenario.lower = {-1.5, 0.25};
    const StaticGeometry geometry(scenario);
    const PlanningGrid grid = build_planning_grid(geometry, 1.0, 0.25, 0.1);
    const dmrp_grid sdk_grid = grid.view();
    const GridView view(sdk_grid);
    REQUIRE(view.width() == 14);
    REQUIRE(view.height() == 12);
    CHECK(view.center(std::uint32_t{0}) == dmrp_vec2{-1.0, 0.75});
    for (std::uint32_t index = 0; index < view.size(); ++index) {
      const double clearance = clearance_by_looking(geometry, view.center(index));
      CHECK(view.clearance(index) == static_cast<float>(clearance));
      CHECK(view.free(index) == (clearance >= 0.35 - 1e-9));
      for (int direction = 0; direction < 8; ++direction) {
        const std::uint32_t to = view.neighbour(index, direction);
        bool expected = to != toolkit::no_cell && view.free(index) && view.free(to);
        if (expected && toolkit::is_diagonal(direction)) {
          const Cell a = view.cell(index);
          const Cell b = view.cell(to);
          expected = view.free(Cell{a.column, b.row}) && view.free(Cell{b.column, a.row});
        }
        if (expected) {
          const double least = clearance_along(geometry, view.center(index), view.center(to));
          if (std::abs(least - 0.25) < 0.005) continue;  // sampling cannot tell
          expected = least > 0.25;
        }
        CHECK(view.edge(index, direction) == expected);
      }
    }
  }
}

TEST_CASE("a thin wall between two free cells closes the move between them") {
  Scenario scenario = empty_scenario(4, 3);
  scenario.shapes = {box("partition", {1.98, 0.0}, {2.02, 2.0})};
  const StaticGeometry geometry(scenario);
  const PlanningGrid grid = build_planning_grid(geometry, 1.0, 0.25, 0.1);
  const dmrp_grid sdk_grid = grid.view();
  const GridView view(sdk_grid);
  for (std::uint32_t index = 0; index < view.size(); ++index) CHECK(view.free(index));
  CHECK(view.edges(view.index({1, 0})) == (DMRP_EDGE_W | DMRP_EDGE_NW | DMRP_EDGE_N));
  CHECK(view.edges(view.index({2, 0})) == (DMRP_EDGE_E | DMRP_EDGE_NE | DMRP_EDGE_N));
  // above the wall's end the way is open straight ahead, but the diagonals would cut its corner
  CHECK(view.edge(view.index({1, 2}), 0));
  CHECK_FALSE(view.edge(view.index({1, 1}), 1));
  CHECK_FALSE(view.edge(view.index({1, 2}), 7));
}

TEST_CASE("a gap of exactly the size needed is open") {
  Scenario scenario = empty_scenario(3, 3);
  // 0.7 m between two blocks: clearance 0.35 m in the middle
  scenario.shapes = {box("left", {0, 1}, {1.15, 2}), box("right", {1.85, 1}, {3, 2})};
  const StaticGeometry geometry(scenario);
  const PlanningGrid grid = build_planning_grid(geometry, 1.0, 0.25, 0.1);
  const dmrp_grid sdk_grid = grid.view();
  const GridView view(sdk_grid);
  CHECK(view.free(Cell{1, 1}));
  CHECK(view.edge(view.index({1, 1}), 2));
  CHECK(view.edge(view.index({1, 1}), 6));
}

TEST_CASE("people's cells are finer and need no margin") {
  const StaticGeometry geometry(empty_scenario(2, 1));
  const PlanningGrid grid = build_walking_grid(geometry, 0.3);
  CHECK(grid.width == 8);
  CHECK(grid.height == 4);
  const dmrp_grid sdk_grid = grid.view();
  CHECK_FALSE(GridView(sdk_grid).free(Cell{0, 0}));  // 0.125 m from the border
  CHECK(GridView(sdk_grid).free(Cell{1, 1}));        // 0.375 m
  // slender people get through where others don't
  CHECK(build_walking_grid(geometry, 0.1).free[0] == 1);
  CHECK(build_walking_grid(geometry, 0.38).free[grid.width + 1] == 0);
}

TEST_CASE("a grid over a stored world is the grid over its scenario, to the bit") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scenario scenario = random_scenario(seed, 8.0, 12);
    scenario.lower = {-1.5, 0.25};
    const StaticGeometry geometry(scenario);
    const PlanningGrid planning = build_planning_grid(geometry, 1.0, 0.25, 0.1);
    const WorldView view(scenario, RobotSettings{}, SimulationSettings{}, geometry, planning, 5);
    const dmrp::test::TraceInMemory trace(view.world());
    const TraceReader stored(trace.bytes());
    const StaticGeometry again(stored.world());
    for (const double radius_m : {0.0, 0.1, 0.3}) {
      const PlanningGrid expected = build_planning_grid(geometry, walking_resolution_m, radius_m, 0.0);
      const PlanningGrid grid = build_planning_grid(again, walking_resolution_m, radius_m, 0.0);
      CHECK(grid.width == expected.width);
      CHECK(grid.height == expected.height);
      CHECK(grid.origin == expected.origin);
      CHECK(grid.free == expected.free);
      CHECK(grid.edges == expected.edges);
      REQUIRE(grid.clearance.size() == expected.clearance.size());
      CHECK(std::memcmp(grid.clearance.data(), expected.clearance.data(), expected.clearance.size() * sizeof(float)) ==
            0);
    }
  }
}

}  // namespace planning_grid_test
