// SPDX-License-Identifier: MIT
// Latencies of commands, and of the braking time in unavoidable contacts.
#include <catch2/catch.hpp>
#include <cmath>

#include "core/world/contact_events.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

namespace {

constexpr std::int64_t second_ns = 1'000'000'000;

}  // namespace

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

TEST_CASE("the braking time of unavoidable contacts includes the latency") {
  // The robot drives at 0.8 m/s and needs 0.8 s to stop. The person would pass until 1 s before the contact, and walks
  // into the robot's way from then on.
  const auto flags = [](std::int64_t latency_ns) {
    ContactTracker tracker({{1.0, 0.8, latency_ns}});
    dmrp_contact contact{};
    contact.kind = DMRP_CONTACT_PERSON;
    dmrp_agent robot{};
    robot.radius_m = 0.25;
    dmrp_agent person{};
    person.radius_m = 0.3;
    for (int step = 100; step >= 0; --step) {
      const double left_s = 0.02 * step;
      robot.pose = {-0.8 * left_s, 0.0, 0.0};
      robot.velocity = {0.8, 0.0};
      person.pose = {0.55, left_s, 0.0};  // from the side, at 1 m/s
      person.velocity = left_s > 1.0 ? dmrp_vec2{0.0, 3.0} : dmrp_vec2{0.0, -1.0};
      tracker.update(2 * second_ns - std::llround(left_s * 1e9), {&robot, 1}, {&person, 1},
                     {&contact, step == 0 ? std::size_t{1} : std::size_t{0}});
    }
    return contact.flags;
  };
  CHECK((flags(0) & DMRP_CONTACT_UNAVOIDABLE) == 0);
  CHECK((flags(400'000'000) & DMRP_CONTACT_UNAVOIDABLE) != 0);
}
