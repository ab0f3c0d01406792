// SPDX-License-Identifier: MIT
// Robots that are polygons, among walls, robots and people.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>

#include "core/scene/convex_separation.hpp"
#include "core/scene/footprint.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace solid_outlines_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

ConvexPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

RobotSettings type_of(const std::string& name, std::vector<ConvexPolygon> parts) {
  RobotSettings type;
  type.type = name;
  type.radius_m = circumscribed_radius(parts);
  type.parts = std::move(parts);
  return type;
}

RobotTypes types() {
  RobotTypes types;
  types.put(type_of("transporter", {rectangle(-0.6, -0.3, 0.6, 0.3)}));
  types.put(type_of("tee", {rectangle(-0.4, -0.15, 0.4, 0.15), rectangle(0.2, -0.4, 0.4, 0.4)}));
  RobotSettings base = type_of("base", {rectangle(-0.3, -0.3, 0.3, 0.3)});
  base.drive = Drive::holonomic;
  base.v_y_max = 0.8;
  types.put(base);
  return types;
}

void add_robot(Scenario& scenario, const std::string& type, const dmrp_pose& start) {
  scenario.robots.push_back({"robot", start, {{100.0, 100.0, 0.0}}, type});
}

std::vector<ConvexPolygon> outline(const World& world, std::uint32_t robot) {
  std::vector<ConvexPolygon> placed;
  for (const ConvexPolygon& part : world.robot_settings(robot).parts)
    placed.push_back(toolkit::to_world(world.robots()[robot].pose, part));
  return placed;
}

// The deepest overlap of the robots with each other, shapes, people and the border; written apart from core's own.
double deepest_overlap(const World& world) {
  double least_m = 1.0;
  const auto& geometry = world.geometry();
  for (std::uint32_t i = 0; i < world.robots().size(); ++i) {
    for (const ConvexPolygon& part : outline(world, i)) {
      least_m = std::min(least_m, geometry.clearance(part, 1.0));
      for (const dmrp_person& person : world.people())
        least_m = std::min(least_m, separation(part, person.position, person.radius_m).distance_m);
      for (std::uint32_t k = 0; k < world.robots().size(); ++k) {
        if (k == i) continue;
        const RobotState& other = world.robots()[k];
        if (world.robot_settings(k).parts.empty())
          least_m = std::min(least_m, separation(part, toolkit::position(other.pose), 0.25).distance_m);
        for (const ConvexPolygon& other_part : outline(world, k))
          least_m = std::min(least_m, separation(part, other_part).distance_m);
      }
    }
  }
  return -least_m;
}

TEST_CASE("polygons that drive anywhere never get deeper into anything than the tolerance") {
  const std::uint64_t seed = GENERATE(1, 2, 3, 4, 5, 6);
  CAPTURE(seed);
  Scenario scenario = empty_scenario(8, 8);
  scenario.shapes = {box("block", {3.0, 3.0}, {4.5, 3.6}), circle("pillar", {6.0, 5.5}, 0.4),
                     box("bar", {0.5, 5.5}, {3.0, 5.7})};
  add_robot(scenario, "transporter", {1.2, 1.2, 0.4});
  add_robot(scenario, "tee", {5.8, 1.5, 2.0});
  add_robot(scenario, "base", {2.0, 4.4, 0.0});
  add_robot(scenario, "", {4.6, 4.8, 0.0});
  add_robot(scenario, "transporter", {6.5, 3.4, 1.5});
  scenario.regions = {{"west", {0, 0}, {1.5, 8}}, {"east", {6.5, 0}, {8, 8}}};
  scenario.flows = {{"across", {0, 1}, 6}};
  World world(scenario, types(), SimulationSettings{}, geometry_of(scenario), seed);
  toolkit::Stream stream(seed, "test.solid_outlines");
  double deepest_m = -1.0;
  for (int step = 0; step < 3000; ++step) {
    if (step % 50 == 0)
      for (std::uint32_t i = 0; i < 5; ++i)
        world.set_command(
            i, {stream.uniform(0.0, 0.8), i == 2 ? stream.uniform(-0.8, 0.8) : 0.0, stream.uniform(-1.0, 1.0)});
    std::vector<dmrp_vec2> velocities;
    for (const dmrp_person& person : world.people())
      velocities.push_back(1.2 * toolkit::normalized(person.target - person.position));
    const auto contacts = world.step(velocities);
    const double overlap_m = deepest_overlap(world);
    deepest_m = std::max(deepest_m, overlap_m);
    // a contact is reported if, and only if, there is one
    const auto with_polygon = [&](const dmrp_contact& contact) {
      return !world.robot_settings(contact.a).parts.empty() ||
             (contact.kind == DMRP_CONTACT_ROBOT && !world.robot_settings(contact.b).parts.empty());
    };
    REQUIRE(std::any_of(contacts.begin(), contacts.end(), with_polygon) == (overlap_m > contact_depth_m));
  }
  CHECK(deepest_m > contact_depth_m);  // they were in contact
  CHECK(deepest_m < solid_depth_m + 1e-5);
}

TEST_CASE("a transporter cannot turn in a corridor narrower than its diagonal, and drives through it") {
  Scenario scenario = empty_scenario(12, 0.9);
  add_robot(scenario, "transporter", {1.0, 0.45, 0.0});
  World world(scenario, types(), SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.0, 0.0, 0.5});
  for (int step = 0; step < 500; ++step) world.step({});
  const double stuck_rad = world.robots()[0].pose.theta;
  // its corners touch both walls: 0.6 sin + 0.3 cos = 0.45, and the tolerance
  CHECK(0.6 * std::sin(stuck_rad) + 0.3 * std::cos(stuck_rad) == Approx(0.45).margin(solid_depth_m + 1e-4));
  CHECK(std::abs(world.robots()[0].velocity.omega) < 0.05);

  // back, and on
  world.set_command(0, {0.0, 0.0, -0.5});
  while (world.robots()[0].pose.theta > 0.0) world.step({});
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int step = 0; step < 500; ++step) world.step({});
  CHECK(world.robots()[0].pose.x > 6.0);
}

TEST_CASE("a rectangle slides along a wall and reports the contact") {
  Scenario scenario = empty_scenario(10, 10);
  scenario.shapes = {box("wall", {0, 5}, {10, 6})};
  add_robot(scenario, "transporter", {2.0, 4.0, 0.3});
  World world(scenario, types(), SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.5, 0.0, 0.0});
  bool touched = false;
  for (int step = 0; step < 400; ++step) {
    const auto contacts = world.step({});
    for (const dmrp_contact& contact : contacts) {
      touched = true;
      CHECK(contact.kind == DMRP_CONTACT_STATIC);
      CHECK(contact.point.y == Approx(5.0).margin(0.002));
    }
  }
  CHECK(touched);
  CHECK(world.robots()[0].pose.x > 3.0);
  CHECK(world.robots()[0].pose.theta == Approx(0.3));
}

TEST_CASE("a robot in contact can leave") {
  Scenario scenario = empty_scenario(10, 10);
  add_robot(scenario, "base", {5.0, 0.31, 0.0});
  World world(scenario, types(), SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.0, -0.8, 0.0});
  for (int step = 0; step < 50; ++step) world.step({});
  CHECK(world.contacts().size() == 1);
  world.set_command(0, {0.0, 0.8, 0.0});
  for (int step = 0; step < 100; ++step) world.step({});
  CHECK(world.robots()[0].pose.y > 1.0);
  CHECK(world.contacts().empty());
}

TEST_CASE("commands beyond a drive's ability are counted") {
  Scenario scenario = empty_scenario(10, 10);
  add_robot(scenario, "", {5.0, 5.0, 0.0});
  add_robot(scenario, "base", {2.0, 2.0, 0.0});
  World world(scenario, types(), SimulationSettings{}, geometry_of(scenario), 1);
  for (std::uint32_t i = 0; i < 2; ++i) world.set_command(i, {0.5, 0.5, 0.0});
  CHECK(world.robots()[0].clipped_commands == 1);
  CHECK(world.robots()[1].clipped_commands == 0);
}

}  // namespace solid_outlines_test
