// SPDX-License-Identifier: MIT
#include "core/scene/world_view.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <string>
#include <utility>

#include "core/scene/planning_grid.hpp"
#include "core/scene/static_geometry.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace world_view_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("the world for plugins is complete") {
  Scenario scenario = busy_hall(6);
  scenario.robots = {robot({5, 6, any_heading}, {{25, 6, any_heading}, {5, 6, 1.0}})};
  scenario.robots[0].name = "anna";
  scenario.people.radius_m = 0.35;
  std::unique_ptr<WorldView> view;
  {
    const StaticGeometry geometry(scenario);
    const PlanningGrid planning = build_planning_grid(geometry, 1.0, 0.25, 0.1);
    view = std::make_unique<WorldView>(scenario, RobotSettings{}, SimulationSettings{}, geometry, planning, 5);
  }
  const WorldView moved(std::move(*view));
  const dmrp_world& world = moved.world();
  CHECK(world.struct_size == sizeof(dmrp_world));
  CHECK(world.person_count == 6);
  CHECK(world.person_radius_m == 0.35);
  CHECK(world.call_budget_ns == 5);
  CHECK(world.upper == dmrp_vec2{30, 12});
  REQUIRE(world.robot_count == 1);
  CHECK(std::string(world.robots[0].name) == "anna");
  CHECK(std::string(world.robots[0].type).empty());
  CHECK(world.robots[0].kinematics == DMRP_KINEMATICS_DIFFERENTIAL);
  REQUIRE(world.robots[0].goal_count == 2);
  CHECK(world.robots[0].goals[1].pose.theta == 1.0);
  CHECK(world.robots[0].goals[0].settle_ns == 500'000'000);
  CHECK(world.robots[0].limits->v_max == 0.8);
  CHECK(world.robots[0].limits->wheelbase_m == 0.0);
  CHECK(world.robots[0].footprint->radius_m == 0.25);
  CHECK(world.robots[0].footprint->part_count == 0);
  CHECK(world.robots[0].footprint->parts == nullptr);
  CHECK(world.robots[0].start.theta == 0.0);
  REQUIRE(world.shape_count == 2);
  CHECK(std::string(world.shapes[1].name) == "planter");
  CHECK(world.shapes[1].kind == DMRP_SHAPE_CIRCLE);
  CHECK(world.shapes[0].vertices[2] == dmrp_vec2{16, 8});
  CHECK(world.segment_count == 4 + 24 + 4);
  CHECK(world.planning_grid->width == 30);
  CHECK(world.planning_grid->free[0] == 1);
  CHECK(world.planning_grid->free[5 * 30 + 14] == 0);  // in the kiosk
}

TEST_CASE("a world without people has no radius of people") {
  const Scenario scenario = busy_hall(0);
  const StaticGeometry geometry(scenario);
  const PlanningGrid planning = build_planning_grid(geometry, 1.0, 0.25, 0.1);
  const WorldView view(scenario, RobotSettings{}, SimulationSettings{}, geometry, planning, 5);
  CHECK(view.world().person_count == 0);
  CHECK(view.world().person_radius_m == 0.0);
}

}  // namespace world_view_test
