// SPDX-License-Identifier: MIT
// bench_simulation: how much faster than real time the bare world runs: no plugins, robots on constant commands, people
// straight ahead to where they want to go.
//
//   simulation/mall_bare/real_time_factor    4 robots, 12 people, 50 Hz
//   simulation/mall_lidar/real_time_factor   the same with lidars of 360 beams at 10 Hz
//   simulation/mall_costmap/real_time_factor the same with local costmaps on these
//   simulation/hall_bare/real_time_factor    100 robots, 1,000 people, 50 Hz
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <dmrp/toolkit/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "bench_simulation_world.hpp"
#include "core/costmap.hpp"
#include "core/flow_routes.hpp"
#include "core/lidar.hpp"
#include "core/planning_grid.hpp"
#include "core/sensing.hpp"
#include "core/world.hpp"

namespace {

using namespace dmrp;

struct Row {
  std::string name;
  double value;
  std::string unit;
};

enum class Sensors { none, lidar, costmap };

struct Setup {
  core::Scenario scenario;
  Sensors sensors;
  double duration_s;
};

// Of processor time: of one core, whoever else is using the machine.
double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

void sense(const core::World& world, core::Lidar& lidar, std::vector<std::unique_ptr<core::LocalCostmap>>& costmaps,
           std::vector<float>& ranges) {
  for (std::uint32_t robot = 0; robot < world.robots().size(); ++robot) {
    core::scan_from(world, robot, lidar, ranges);
    if (!costmaps.empty()) costmaps[robot]->update(world.robots()[robot].pose, lidar.describe(world.t_ns(), ranges));
  }
}

// Simulated over used time.
double real_time_factor(const Setup& setup) {
  const core::Scenario& scenario = setup.scenario;
  const core::RobotSettings robot;
  const core::SimulationSettings settings;
  const auto geometry = std::make_shared<const core::StaticGeometry>(scenario);
  const core::FlowRoutes routes = core::find_flow_routes(scenario, core::build_walking_grid(*geometry));
  core::World world(scenario, robot, settings, geometry, routes, 1);
  core::Lidar lidar(robot.lidar, geometry);
  std::vector<float> ranges(lidar.beams());
  std::vector<std::unique_ptr<core::LocalCostmap>> costmaps;
  if (setup.sensors == Sensors::costmap)
    for (std::size_t i = 0; i < scenario.robots.size(); ++i)
      costmaps.push_back(std::make_unique<core::LocalCostmap>(robot.costmap, robot.radius_m));

  const std::clock_t start = std::clock();
  std::vector<dmrp_vec2> velocities(core::person_count(scenario));
  const std::int64_t steps_per_tick = settings.control_period_ns / settings.step_ns;
  const auto steps = static_cast<std::int64_t>(setup.duration_s * 1e9) / settings.step_ns;
  for (std::int64_t step = 0; step < steps; ++step) {
    if (step % steps_per_tick == 0) {
      if (setup.sensors != Sensors::none) sense(world, lidar, costmaps, ranges);
      for (std::uint32_t i = 0; i < scenario.robots.size(); ++i)
        world.set_command(i, {0.6, 0.0, i % 2 == 0 ? 0.15 : -0.15});
    }
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      const dmrp_person& person = world.people()[i];
      velocities[i] = person.desired_speed * toolkit::normalized(person.target - person.position);
    }
    world.step(velocities);
  }
  return setup.duration_s / seconds_since(start);
}

double median_of_three(const Setup& setup) {
  std::vector<double> factors;
  for (int i = 0; i < 3; ++i) factors.push_back(real_time_factor(setup));
  std::sort(factors.begin(), factors.end());
  return factors[1];
}

}  // namespace

int main(int argc, char** argv) {
  const bool json = argc > 1 && std::strcmp(argv[1], "--json") == 0;
  const core::Scenario mall = bench::make_mall(4, 12);
  const core::Scenario hall = bench::make_hall(100, 1000);
  const std::vector<Row> rows = {
      {"simulation/mall_bare/real_time_factor", median_of_three({mall, Sensors::none, 600.0}), "1"},
      {"simulation/mall_lidar/real_time_factor", median_of_three({mall, Sensors::lidar, 120.0}), "1"},
      {"simulation/mall_costmap/real_time_factor", median_of_three({mall, Sensors::costmap, 120.0}), "1"},
      {"simulation/hall_bare/real_time_factor", median_of_three({hall, Sensors::none, 20.0}), "1"}};
  if (json) std::printf("[");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (json) {
      std::printf("%s\n  {\"name\": \"%s\", \"value\": %.6g, \"unit\": \"%s\"}", i == 0 ? "" : ",",
                  rows[i].name.c_str(), rows[i].value, rows[i].unit.c_str());
    } else {
      std::printf("%-45s %12.6g %s\n", rows[i].name.c_str(), rows[i].value, rows[i].unit.c_str());
    }
  }
  if (json) std::printf("\n]\n");
  return 0;
}
