// SPDX-License-Identifier: MIT
// A robot's sensors as the extensions of its controller, while the world advances.
#include "host/trial/robot_sensors.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <vector>

#include "host/trial/robot_sensors.hpp"

namespace robot_sensors_test {

using namespace dmrp;
using namespace dmrp::host;

constexpr double any_heading = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t seed = 5;

// Three robots in a hall of 12 x 8 m with a wall across a part of it: the first drives, the second stands in front of it,
// the third is behind the wall.
struct Hall {
  core::RobotSettings robot;
  core::SimulationSettings simulation;
  core::Scenario scenario;
  std::shared_ptr<const core::StaticGeometry> geometry;
  std::unique_ptr<core::World> world;
  std::unique_ptr<core::Sight> sight;
  std::unique_ptr<core::Lidar> lidar;

  void open() {
    scenario.name = "hall";
    scenario.upper = {12.0, 8.0};
    core::Shape wall;
    wall.name = "wall";
    wall.vertices = {{6.0, 4.0}, {6.2, 4.0}, {6.2, 8.0}, {6.0, 8.0}};
    scenario.shapes = {wall};
    scenario.robots = {{"driver", {3.0, 2.0, 0.0}, {{11.0, 2.0, any_heading}}},
                       {"idle", {5.0, 2.6, 0.0}, {{11.0, 6.0, any_heading}}},
                       {"hidden", {7.5, 6.0, 0.0}, {{11.0, 7.0, any_heading}}}};
    geometry = std::make_shared<const core::StaticGeometry>(scenario);
    world = std::make_unique<core::World>(scenario, robot, simulation, geometry, seed);
    sight = std::make_unique<core::Sight>(*world);
    lidar = std::make_unique<core::Lidar>(robot.lidar, geometry);
  }

  void control_period() {
    world->set_command(0, {0.5, 0.0, 0.2});
    for (int i = 0; i < 5; ++i) world->step({});
  }
};

// The sensors of one of its robots, and the extensions of the controller that drives it.
struct Sensors {
  explicit Sensors(Hall& hall, std::uint64_t trial_seed = seed, std::uint32_t robot = 0)
      : readings(std::make_shared<RobotSensors>(*hall.sight, robot, *hall.lidar, trial_seed)),
        extensions(readings_of(by_robot(readings, robot))) {}

  static std::vector<std::shared_ptr<RobotSensors>> by_robot(std::shared_ptr<RobotSensors> readings,
                                                             std::uint32_t robot) {
    std::vector<std::shared_ptr<RobotSensors>> all(robot);
    all.push_back(std::move(readings));
    return all;
  }
  RobotSensors* operator->() const { return readings.get(); }

  template <class Extension>
  const Extension* ask(const char* id) {
    return static_cast<const Extension*>(extensions.extension(id));
  }

  std::shared_ptr<RobotSensors> readings;
  SensorReadings extensions;
};

std::vector<float> ranges_of(Sensors& sensors) {
  const auto* lidar = sensors.ask<dmrp_lidar>(DMRP_EXT_LIDAR);
  const dmrp_scan& scan = *lidar->scan(lidar, 0);
  return {scan.ranges, scan.ranges + scan.count};
}

// The number of clusters within a distance of a point.
int clusters_near(Sensors& sensors, dmrp_vec2 point, double reach_m) {
  const auto* extension = sensors.ask<dmrp_obstacle_clusters>(DMRP_EXT_OBSTACLE_CLUSTERS);
  const dmrp_obstacle_cluster_list& list = *extension->clusters(extension, 0);
  int count = 0;
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const auto& cluster = *DMRP_AT(dmrp_obstacle_cluster, list.clusters, list.stride, i);
    bool near = false;
    for (std::uint32_t k = 0; k < cluster.vertex_count; ++k)
      near = near || toolkit::distance(cluster.vertices[k], point) < reach_m;
    count += near;
  }
  return count;
}

TEST_CASE("a visible robot comes as an agent, a hidden one not at all; without tracking only the costmap has it") {
  Hall hall;
  hall.simulation.tracking = GENERATE(core::Tracking::visible, core::Tracking::none);
  hall.open();
  Sensors sensors(hall);
  const bool told = hall.simulation.tracking == core::Tracking::visible;
  REQUIRE(sensors->agents().size() == (told ? 1 : 0));
  if (told) CHECK(sensors->agents()[0].id == 1);

  // its front is lethal either way
  const auto* extension = sensors.ask<dmrp_local_costmap>(DMRP_EXT_LOCAL_COSTMAP);
  const dmrp_costmap& costmap = *extension->costmap(extension, 0);
  int lethal = 0;
  for (std::uint32_t row = 0; row < costmap.height; ++row)
    for (std::uint32_t column = 0; column < costmap.width; ++column) {
      const dmrp_vec2 center = costmap.origin + costmap.resolution_m * dmrp_vec2{column + 0.5, row + 0.5};
      if (costmap.costs[row * costmap.width + column] == DMRP_COST_LETHAL &&
          toolkit::distance(center, {5.0, 2.6}) < 0.3)
        ++lethal;
    }
  CHECK(lethal > 4);
  CHECK((clusters_near(sensors, {5.0, 2.6}, 0.35) > 0) == !told);
}

TEST_CASE("robots that have arrived or failed are still told of, as what they are") {
  Hall hall;
  hall.open();
  hall.world->fail(1);
  hall.world->step({});
  Sensors sensors(hall);
  REQUIRE(sensors->agents().size() == 1);
  CHECK(sensors->agents()[0].state == DMRP_ROBOT_FAILED);
  CHECK(sensors->agents()[0].velocity == dmrp_vec2{0.0, 0.0});
}

TEST_CASE("noise depends on the seed, the robot and the time alone, not on who asked before") {
  Hall hall;
  hall.robot.lidar.noise_sd_m = 0.03;
  hall.robot.lidar.dropout_share = 0.1;
  hall.simulation.tracking = core::Tracking::all;
  hall.simulation.tracking_velocity_noise_sd = 0.2;
  hall.open();
  Sensors eager(hall);
  Sensors lazy(hall);
  Sensors other_seed(hall, seed + 1);
  eager.extensions.extension(DMRP_EXT_DISTANCE_FIELD);
  const std::vector<float> first = ranges_of(eager);
  for (int i = 0; i < 4; ++i) {
    hall.control_period();
    for (Sensors* sensors : {&eager, &lazy, &other_seed}) (*sensors)->tick();
    ranges_of(eager);
    eager->agents();
    eager->agents();
  }
  CHECK(ranges_of(eager) == ranges_of(lazy));
  CHECK(ranges_of(eager) != first);
  CHECK(ranges_of(eager) != ranges_of(other_seed));
  REQUIRE(eager->agents().size() == 2);
  CHECK(std::memcmp(eager->agents().data(), lazy->agents().data(), 2 * sizeof(dmrp_agent)) == 0);
  CHECK(eager->agents()[0].velocity != lazy->agents()[1].velocity);
  CHECK(eager->agents()[0].velocity != other_seed->agents()[0].velocity);
}

TEST_CASE("noise leaves the world as it is") {
  Hall quiet;
  quiet.open();
  Hall noisy;
  noisy.robot.lidar.noise_sd_m = 0.1;
  noisy.robot.lidar.dropout_share = 0.3;
  noisy.simulation.tracking_velocity_noise_sd = 1.0;
  noisy.open();
  Sensors sensors(noisy);
  sensors.extensions.extension(DMRP_EXT_LOCAL_COSTMAP);
  for (int i = 0; i < 10; ++i) {
    quiet.control_period();
    noisy.control_period();
    sensors->tick();
    sensors->agents();
  }
  CHECK(std::memcmp(&quiet.world->robots()[0].pose, &noisy.world->robots()[0].pose, sizeof(dmrp_pose)) == 0);
  CHECK(quiet.world->robot_agents()[1].velocity == noisy.world->robot_agents()[1].velocity);
}

}  // namespace robot_sensors_test
