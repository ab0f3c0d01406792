// SPDX-License-Identifier: MIT
#include "host/trial/observation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/unit/host/trial/stage.hpp"

namespace observation_test {

using namespace dmrp;

TEST_CASE("a controller sees how far the wheels of its car are turned") {
  core::RobotSettings car;
  car.drive = core::Drive::ackermann;
  car.wheelbase_m = 0.4;
  car.steering_max = 0.5;
  car.steering_rate_max = 1.0;
  host::Experiment experiment;
  experiment.scenarios = {{test::hall(1), "hall", ""}};
  experiment.scenarios[0].types = core::RobotTypes(car);
  const host::VariantWorld variant(experiment, experiment.scenarios[0]);
  core::World world(variant.scenario, variant.types, variant.simulation, variant.geometry, 1);
  core::Lidar lidar(car.lidar, variant.geometry);
  core::Sight sight(world);
  host::RobotSensors sensors(sight, 0, lidar, 1);
  const auto steering_angle = [&] { return observation_of(0, {}, variant, world, sensors).steering_angle; };
  CHECK(steering_angle() == 0.0);
  world.set_command(0, {0.2, 0.0, 0.2});
  for (int i = 0; i < 10; ++i) world.step({});
  // turned for 0.2 s at 1 rad/s
  CHECK(steering_angle() == Approx(0.2).epsilon(0.2));
  for (int i = 0; i < 100; ++i) world.step({});
  // omega = v_x tan(steering) / wheelbase
  CHECK(steering_angle() == Approx(std::atan(0.2 * 0.4 / 0.2)).epsilon(1e-6));
}

TEST_CASE("with its latency compensated, a controller sees the state in which its command takes effect") {
  core::RobotSettings robot;
  robot.actuation_latency_ns = 100'000'000;
  host::Experiment experiment;
  experiment.simulation.control_latency_ns = 200'000'000;
  experiment.scenarios = {{test::hall(1), "hall", ""}};
  experiment.scenarios[0].types = core::RobotTypes(robot);
  const auto drive = [&](auto see) {
    const host::VariantWorld variant(experiment, experiment.scenarios[0]);
    core::World world(variant.scenario, variant.types, variant.simulation, variant.geometry, 1);
    core::Lidar lidar(robot.lidar, variant.geometry);
    core::Sight sight(world);
    host::RobotSensors sensors(sight, 0, lidar, 1);
    for (int tick = 0; tick < 20; ++tick) {
      see(tick, observation_of(0, {}, variant, world, sensors));
      world.set_command(0, {0.1 + 0.02 * tick, 0.0, tick < 10 ? 0.3 : -0.3});
      for (int i = 0; i < 5; ++i) world.step({});
      sensors.tick();
    }
  };
  std::vector<dmrp_observation> late;
  drive([&](int, const dmrp_observation& seen) { late.push_back(seen); });
  experiment.simulation.navigation.compensate_latency = true;
  // 0.3 s are three ticks
  drive([&](int tick, const dmrp_observation& seen) {
    if (tick + 3 >= 20) return;
    const dmrp_observation& then = late[static_cast<std::size_t>(tick) + 3];
    CHECK(seen.pose.x == Approx(then.pose.x).margin(1e-12));
    CHECK(seen.pose.y == Approx(then.pose.y).margin(1e-12));
    CHECK(seen.pose.theta == Approx(then.pose.theta).margin(1e-12));
    CHECK(seen.velocity.v_x == Approx(then.velocity.v_x).margin(1e-12));
    CHECK(seen.velocity.omega == Approx(then.velocity.omega).margin(1e-12));
    CHECK(seen.t_ns == late[static_cast<std::size_t>(tick)].t_ns);
  });
}

}  // namespace observation_test
