// SPDX-License-Identifier: MIT
#include "tests/bench/bench_simulation_world.hpp"

#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "host/scenario/find_scenario.hpp"
#include "host/scenario/read_scenario.hpp"

namespace dmrp::bench {
namespace {

core::Shape planter(double x, double y, double radius_m) {
  core::Shape shape;
  shape.name = "planter";
  shape.kind = core::Shape::Kind::circle;
  shape.center = {x, y};
  shape.radius_m = radius_m;
  return shape;
}

void add_robot(core::Scenario& scenario, dmrp_vec2 start, dmrp_vec2 goal) {
  constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();
  core::RobotTask task;
  task.name = "robot " + std::to_string(scenario.robots.size());
  task.start = {start.x, start.y, free_heading};
  task.goals = {{goal.x, goal.y, free_heading}};
  scenario.robots.push_back(task);
}

}  // namespace

core::Scenario shipped_mall() {
  for (const std::filesystem::path& folder : host::scenario_folders()) {
    const std::filesystem::path file = folder / "mall" / "scenario.toml";
    if (std::filesystem::exists(file)) return host::read_scenario_file(file, file.string()).scenario;
  }
  throw std::runtime_error("the mall is not installed");
}

core::Scenario make_hall(std::uint32_t robots, std::uint32_t people) {
  core::Scenario scenario;
  scenario.name = "hall";
  scenario.upper = {100.0, 60.0};
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 5; ++row) scenario.shapes.push_back(planter(10.0 + 10.0 * column, 10.0 + 10.0 * row, 0.4));
  for (std::uint32_t i = 0; i < robots; ++i) {
    const double x = 1.0 + 98.0 * (i / 2 + 0.5) / (robots / 2.0 + 0.5);
    add_robot(scenario, {x, i % 2 == 0 ? 2.0 : 58.0}, {x, i % 2 == 0 ? 58.0 : 2.0});
  }
  // five lanes, both ways
  for (std::uint32_t lane = 0; lane < 5; ++lane) {
    const double y = 6.0 + 10.0 * lane;
    scenario.regions.push_back({"west", {1.0, y}, {4.0, y + 8.0}});
    scenario.regions.push_back({"east", {96.0, y}, {99.0, y + 8.0}});
    scenario.flows.push_back({"eastward", {2 * lane, 2 * lane + 1}, people / 10});
    scenario.flows.push_back({"westward", {2 * lane + 1, 2 * lane}, people / 10});
  }
  return scenario;
}

}  // namespace dmrp::bench
