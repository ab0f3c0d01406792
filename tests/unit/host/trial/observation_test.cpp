// SPDX-License-Identifier: MIT
#include "host/trial/observation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

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

}  // namespace observation_test
