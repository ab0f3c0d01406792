// SPDX-License-Identifier: MIT
// The contacts of a crowded world against closed forms of every pair of bodies.
#include "core/world/collision_checks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <map>
#include <tuple>

#include "core/scene/convex_separation.hpp"
#include "core/scene/footprint.hpp"
#include "core/world/world.hpp"
#include "tests/support/draws.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace collision_checks_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

// A body as closed forms know it: a disc, or convex polygons.
struct Outline {
  dmrp_vec2 center{};
  double radius_m = 0.0;
  std::vector<ConvexPolygon> parts{};
};

double depth_of(const Outline& a, const Outline& b) {
  if (a.parts.empty() && b.parts.empty()) return a.radius_m + b.radius_m - toolkit::distance(a.center, b.center);
  if (a.parts.empty()) return depth_of(b, a);
  double gap_m = 1e9;
  for (const ConvexPolygon& part : a.parts) {
    if (b.parts.empty()) gap_m = std::min(gap_m, separation(part, b.center, b.radius_m).distance_m);
    for (const ConvexPolygon& other : b.parts) gap_m = std::min(gap_m, separation(part, other).distance_m);
  }
  return -gap_m;
}

double depth_in_border(const Outline& body, const toolkit::Rectangle& rectangle) {
  double gap_m = toolkit::depth(rectangle, body.center) - body.radius_m;
  for (const ConvexPolygon& part : body.parts)
    for (const dmrp_vec2 vertex : part) gap_m = std::min(gap_m, toolkit::depth(rectangle, vertex));
  return -gap_m;
}

Outline outline_of(const World& world, std::uint32_t robot) {
  const RobotSettings& type = world.robot_settings(robot);
  const dmrp_pose& pose = world.robots()[robot].pose;
  Outline outline{toolkit::position(pose), type.parts.empty() ? type.radius_m : 0.0};
  for (const ConvexPolygon& part : type.parts) outline.parts.push_back(toolkit::to_world(pose, part));
  return outline;
}

Outline outline_of(const dmrp_shape& shape) {
  if (shape.kind == DMRP_SHAPE_CIRCLE) return {shape.center, shape.radius_m};
  return {{}, 0.0, {ConvexPolygon(shape.vertices, shape.vertices + shape.vertex_count)}};
}

using Contacts = std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, double>;  // kind, a, b: depth

// Of every pair, as if each robot stood shifted_m to the right of where it is.
Contacts closed_form_contacts(const World& world, double shifted_m) {
  Contacts contacts;
  const auto note = [&](std::uint32_t kind, std::uint32_t a, std::uint32_t b, double depth_m) {
    if (depth_m > contact_depth_m) contacts[{kind, a, b}] = depth_m;
  };
  const auto count = static_cast<std::uint32_t>(world.robots().size());
  for (std::uint32_t a = 0; a < count; ++a) {
    Outline robot = outline_of(world, a);
    robot.center.x += shifted_m;
    for (ConvexPolygon& part : robot.parts)
      for (dmrp_vec2& vertex : part) vertex.x += shifted_m;
    for (std::uint32_t b = 0; b < world.geometry().border(); ++b)
      note(DMRP_CONTACT_STATIC, a, b, depth_of(robot, outline_of(world.geometry().sdk_shapes()[b])));
    note(DMRP_CONTACT_STATIC, a, world.geometry().border(), depth_in_border(robot, world.geometry().rectangle()));
    for (std::uint32_t b = a + 1; b < count; ++b) note(DMRP_CONTACT_ROBOT, a, b, depth_of(robot, outline_of(world, b)));
    for (std::uint32_t b = 0; b < world.people().size(); ++b)
      note(DMRP_CONTACT_PERSON, a, b, depth_of(robot, {world.people()[b].position, world.people()[b].radius_m}));
  }
  return contacts;
}

// Contacts that only one of the two has, or whose depths differ by a nanometre.
int differences(const Contacts& some, const Contacts& others) {
  int different = 0;
  for (const auto& [pair, depth_m] : some) {
    const auto same = others.find(pair);
    if (same == others.end() || !(std::abs(same->second - depth_m) < 1e-9)) ++different;
  }
  for (const auto& [pair, depth_m] : others) different += some.contains(pair) ? 0 : 1;
  return different;
}

ConvexPolygon rectangle(double half_length_m, double half_width_m) {
  return {{-half_length_m, -half_width_m},
          {half_length_m, -half_width_m},
          {half_length_m, half_width_m},
          {-half_length_m, half_width_m}};
}

void add_type(RobotTypes& types, const std::string& name, std::vector<ConvexPolygon> parts) {
  RobotSettings type;
  type.type = name;
  type.radius_m = circumscribed_radius(parts);
  type.parts = std::move(parts);
  type.drive = Drive::holonomic;
  type.v_y_max = 0.8;
  types.put(type);
}

// Fourteen robots of six outlines, six people and eight shapes in 9 m x 9 m.
Scenario crowded_scenario(toolkit::Stream& stream) {
  Scenario scenario = random_scenario(stream.next_u64(), 9.0, 8);
  const char* const types[] = {"", "transporter", "tee", "triangle", "hexagon", "square"};
  for (std::uint32_t i = 0; i < 14; ++i)
    scenario.robots.push_back({"robot",
                               {1.2 + 1.8 * (i % 4), 1.2 + 2.2 * (i / 4), stream.uniform(-3.1, 3.1)},
                               {{100.0, 100.0, 0.0}},
                               types[i % 6]});
  scenario.regions = {{"west", {0, 0}, {2, 9}}, {"east", {7, 0}, {9, 9}}};
  scenario.flows = {{"across", {0, 1}, 6}};
  return scenario;
}

TEST_CASE("FCL finds the contacts of a crowd, as deep as closed forms say") {
  RobotTypes types;
  add_type(types, "transporter", {rectangle(0.6, 0.3)});
  add_type(types, "tee", {rectangle(0.3, 0.15), {{0.2, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {0.2, 0.4}}});
  add_type(types, "triangle", {toolkit::polygon_of_circle({0.0, 0.0}, 0.4, 3)});
  add_type(types, "hexagon", {toolkit::polygon_of_circle({0.0, 0.0}, 0.3, 6)});
  add_type(types, "square", {rectangle(0.25, 0.25)});
  std::size_t contacts_seen = 0;
  int of_bodies_shifted = 0;
  for (int seed = 0; seed < dmrp::test::draws(20); ++seed) {
    toolkit::Stream stream(static_cast<std::uint64_t>(seed), "test.collision_checks");
    const Scenario scenario = crowded_scenario(stream);
    World world(scenario, types, SimulationSettings{}, geometry_of(scenario), stream.next_u64());
    for (int step = 0; step < 1000; ++step) {
      for (std::uint32_t i = 0; step % 40 == 0 && i < world.robots().size(); ++i)
        world.set_command(i, {stream.uniform(0.0, 0.8), stream.uniform(-0.8, 0.8), stream.uniform(-1.0, 1.0)});
      std::vector<dmrp_vec2> velocities;
      for (const dmrp_person& person : world.people())
        velocities.push_back(1.2 * toolkit::normalized(person.target - person.position));
      Contacts found;
      for (const dmrp_contact& contact : world.step(velocities))
        found[{contact.kind, contact.a, contact.b}] = contact.depth_m;
      REQUIRE(differences(found, closed_form_contacts(world, 0.0)) == 0);
      contacts_seen += found.size();
      if (step % 100 == 0) of_bodies_shifted += differences(found, closed_form_contacts(world, 1e-5));
    }
  }
  CHECK(contacts_seen > dmrp::test::draws(50'000u));
  CHECK(of_bodies_shifted > dmrp::test::draws(200));  // the comparison sees ten micrometres
}

}  // namespace collision_checks_test
