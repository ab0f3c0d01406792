// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace robot_goals_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double pi = std::numbers::pi;

TEST_CASE("a world tells since when a robot meets its goal; parked, it stays a body") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{5.1, 5}), robot({7, 5, pi}, dmrp_vec2{1, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  for (int i = 0; i < 25; ++i) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  CHECK(world.robots()[0].settling_since_ns == 0);
  CHECK(world.robots()[1].settling_since_ns == -1);
  world.park(0);
  CHECK(world.robots()[0].state == DMRP_ROBOT_FINISHED);
  CHECK(world.robots()[0].arrival_ns == 500'000'000);
  CHECK(world.set_command(0, {0.8, 0.0, 0.0}).v_x == 0.0);
  world.set_command(1, {0.8, 0.0, 0.0});
  for (int i = 0; i < 300; ++i) world.step({});
  CHECK(world.robots()[0].pose.x == 5.0);
  CHECK(world.robots()[1].pose.x == Approx(5.5).margin(0.002));
  CHECK(world.robot_agents()[0].state == DMRP_ROBOT_FINISHED);
}

TEST_CASE("passing a goal at speed does not meet it") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({4, 5, 0}, dmrp_vec2{5, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.8, 0.0, 0.0});
  while (world.robots()[0].pose.x < 6.0) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  CHECK(world.robots()[0].settling_since_ns == -1);
}

TEST_CASE("the goals of a tour become current one after the other, headings where they are given") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, {{5.0, 5.0, any_heading}, {5.0, 5.0, 1.0}})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  for (int i = 0; i < 30; ++i) world.step({});
  CHECK(world.robots()[0].settling_since_ns == 0);
  world.visit(0);
  CHECK(world.robots()[0].goal_index == 1);
  for (int i = 0; i < 100; ++i) world.step({});
  CHECK(world.robots()[0].settling_since_ns == -1);  // not turned yet
  for (int i = 0; i < 300; ++i) {
    world.set_command(0, {0.0, 0.0, 1.0 - world.robots()[0].pose.theta});
    world.step({});
  }
  CHECK(world.robots()[0].settling_since_ns > 2'600'000'000);
}

TEST_CASE("a failed robot brakes and stops") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{15, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 60; ++i) world.step({});
  world.fail(0);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 60; ++i) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_FAILED);
  CHECK(world.robots()[0].velocity.v_x == 0.0);
}

}  // namespace robot_goals_test
