// SPDX-License-Identifier: MIT
// Latencies of commands.
#include <catch2/catch.hpp>

#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace command_latency_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("a command takes effect after the sum of its latencies") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 60'000'000;
  SimulationSettings simulation;
  simulation.control_latency_ns = 100'000'000;  // 0.16 s in all: 8 steps
  World world(scenario, settings, simulation, geometry_of(scenario), 1);
  CHECK(world.set_command(0, {0.5, 0.0, 0.0}).v_x == 0.0);
  std::vector<double> speeds;
  for (int step = 0; step < 30; ++step) {
    if (step == 5) world.set_command(0, {0.0, 0.0, 0.0});  // in effect from step 13 on
    world.step({});
    speeds.push_back(world.robots()[0].velocity.v_x);
  }
  for (int step = 0; step < 8; ++step) CHECK(speeds[step] == 0.0);
  for (int step = 8; step < 13; ++step) CHECK(speeds[step] == Approx(0.02 * (step - 7)));  // 1 m/s^2
  for (int step = 13; step < 18; ++step) CHECK(speeds[step] == Approx(0.02 * (17 - step)).margin(1e-12));
  CHECK(speeds[29] == 0.0);
}

TEST_CASE("a latency that is not a multiple of the step is rounded up, and 0 means at once") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 30'000'000;
  World late(scenario, settings, SimulationSettings{}, geometry_of(scenario), 1);
  World prompt(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  late.set_command(0, {0.5, 0.0, 0.0});
  CHECK(prompt.set_command(0, {0.5, 0.0, 0.0}).v_x == 0.5);
  for (World* world : {&late, &prompt})
    for (int step = 0; step < 3; ++step) world->step({});
  CHECK(late.robots()[0].velocity.v_x == Approx(0.02));
  CHECK(prompt.robots()[0].velocity.v_x == Approx(0.06));
}

TEST_CASE("a failed robot discards its pending commands") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 100'000'000;
  World world(scenario, settings, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.5, 0.0, 0.0});
  world.fail(0);
  for (int step = 0; step < 50; ++step) world.step({});
  CHECK(world.robots()[0].pose.x == 2.0);
}

}  // namespace command_latency_test
