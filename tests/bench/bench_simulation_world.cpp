// SPDX-License-Identifier: MIT
#include "bench_simulation_world.hpp"

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

void add_robot(core::Scenario& scenario, dmrp_vec2 start, dmrp_vec2 goal) {
  constexpr double free_heading = std::numeric_limits<double>::quiet_NaN();
  core::RobotTask task;
  task.name = "robot " + std::to_string(scenario.robots.size());
  task.start = {start.x, start.y, free_heading};
  task.goals = {{goal.x, goal.y, free_heading}};
  scenario.robots.push_back(task);
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
    const double x = 2.5 + 36.0 * (i / 2 + 0.5) / (robots / 2.0 + 0.5);
    add_robot(scenario, {x, i % 2 == 0 ? 15.0 : 25.0}, {x, i % 2 == 0 ? 25.0 : 15.0});
  }
  scenario.regions = {{"west", {1.0, 15.0}, {3.0, 25.0}}, {"east", {37.0, 15.0}, {39.0, 25.0}}};
  scenario.flows = {{"eastward", {0, 1}, people - people / 2}, {"westward", {1, 0}, people / 2}};
  return scenario;
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
