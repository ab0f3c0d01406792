// SPDX-License-Identifier: MIT
#include "core/scene/world_view.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("the world for plugins is complete, also as a copy of a copy") {
  Scenario scenario = busy_hall(6);
  scenario.robots = {robot({5, 6, any_heading}, {{25, 6, any_heading}, {5, 6, 1.0}})};
  scenario.robots[0].name = "anna";
  const StaticGeometry geometry(scenario);
  const PlanningGrid planning = build_planning_grid(geometry, 1.0, 0.25, 0.1);
  const PlanningGrid walking = build_walking_grid(geometry, 0.3);
  std::unique_ptr<WorldView> copy;
  {
    const WorldView view(scenario, RobotSettings{}, SimulationSettings{}, geometry, planning, walking, 5);
    CHECK(view.seen_by(0).self == 0);
    copy = std::make_unique<WorldView>(view.world());
  }
  const WorldView moved(std::move(*copy));
  const WorldView kept(moved.world());
  const dmrp_world& last = kept.world();
  CHECK(last.struct_size == sizeof(dmrp_world));
  CHECK(last.person_count == 6);
  CHECK(last.self == -1);
  CHECK(last.call_budget_ns == 5);
  CHECK(last.upper == dmrp_vec2{30, 12});
  REQUIRE(last.robot_count == 1);
  CHECK(std::string(last.robots[0].name) == "anna");
  REQUIRE(last.robots[0].goal_count == 2);
  CHECK(last.robots[0].goals[1].pose.theta == 1.0);
  CHECK(last.robots[0].goals[0].settle_ns == 500'000'000);
  CHECK(last.robots[0].limits->v_max == 0.8);
  CHECK(last.robots[0].footprint->radius_m == 0.25);
  CHECK(last.robots[0].footprint->vertices == nullptr);
  CHECK(last.robots[0].start.theta == 0.0);
  REQUIRE(last.shape_count == 2);
  CHECK(std::string(last.shapes[1].name) == "planter");
  CHECK(last.shapes[1].kind == DMRP_SHAPE_CIRCLE);
  CHECK(last.shapes[0].vertices[2] == dmrp_vec2{16, 8});
  CHECK(last.segment_count == 4 + 24 + 4);
  CHECK(last.planning_grid->width == 30);
  CHECK(last.planning_grid->free[0] == planning.free[0]);
  CHECK(last.walking_grid->width == 120);
}
