// SPDX-License-Identifier: MIT
#include "bench_simulation_world.hpp"

#include <cmath>
#include <limits>
#include <string>

namespace dmrp::bench {
namespace {

core::Shape box(double x_low, double y_low, double x_high, double y_high) {
  core::Shape shape;
  shape.name = "box";
  shape.vertices = {{x_low, y_low}, {x_high, y_low}, {x_high, y_high}, {x_low, y_high}};
  return shape;
}

core::Shape planter(double x, double y, double radius_m) {
  core::Shape shape;
  shape.name = "planter";
  shape.kind = core::Shape::Kind::circle;
  shape.center = {x, y};
  shape.radius_m = radius_m;
  return shape;
}

// Six shops between two heights, with doors 1.6 m wide toward the thoroughfare and shelves inside.
void add_shops(core::Scenario& scenario, double y_low, double y_high, double y_front) {
  for (int shop = 0; shop <= 6; ++shop) {
    const double x = 0.5 + 6.4 * shop;
    scenario.shapes.push_back(box(x, y_low, x + 0.2, y_high));
    if (shop == 6) break;
    scenario.shapes.push_back(box(x + 0.2, y_front, x + 2.5, y_front + 0.2));
    scenario.shapes.push_back(box(x + 4.1, y_front, x + 6.4, y_front + 0.2));
    for (int shelf = 0; shelf < 3; ++shelf) {
      const double y = y_low + 3.0 + 3.0 * shelf;
      scenario.shapes.push_back(box(x + 1.2, y, x + 5.4, y + 0.6));
    }
  }
}

void add_furniture(core::Scenario& scenario) {
  for (int i = 0; i < 6; ++i) {
    const double x = 5.0 + 6.0 * i;
    scenario.shapes.push_back(box(x - 1.0, 19.5, x + 1.0, 20.5));
    scenario.shapes.push_back(planter(x + 3.0, 17.0, 0.6));
    scenario.shapes.push_back(planter(x + 3.0, 23.0, 0.6));
  }
}

}  // namespace

core::Scenario make_mall(std::uint32_t robots, std::uint32_t people) {
  core::Scenario scenario;
  scenario.name = "mall";
  scenario.lower = {0.0, 0.0};
  scenario.upper = {40.0, 40.0};
  add_shops(scenario, 0.5, 14.0, 13.8);
  add_shops(scenario, 26.0, 39.5, 26.0);
  add_furniture(scenario);

  for (std::uint32_t i = 0; i < robots; ++i) {
    core::RobotTask task;
    task.name = "robot " + std::to_string(i);
    const double x = 2.5 + 36.0 * (i / 2 + 0.5) / (robots / 2.0 + 0.5);
    const double y = i % 2 == 0 ? 15.0 : 25.0;
    task.start = {x, y, std::numeric_limits<double>::quiet_NaN()};
    task.goals = {{x, 40.0 - y, std::numeric_limits<double>::quiet_NaN()}};
    scenario.robots.push_back(task);
  }
  scenario.regions = {{"west", {1.0, 15.0}, {3.0, 25.0}}, {"east", {37.0, 15.0}, {39.0, 25.0}}};
  scenario.flows = {{"eastward", {0, 1}, people - people / 2}, {"westward", {1, 0}, people / 2}};
  return scenario;
}

}  // namespace dmrp::bench
