// SPDX-License-Identifier: MIT
// How E3MoP keeps its distance where there is room, and leaves an obstacle that it stands at: each world is driven from
// 20 starts, with and without the switch.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <functional>
#include <memory>

#include "tests/unit/controllers/controllers.hpp"

using namespace dmrp::test;
using dmrp::toolkit::Stream;

namespace {

constexpr int starts = 20;

struct Outcome {
  int arrived = 0;
  double static_clearance_m = 1e9;  // least
  double walker_clearance_m = 1e9;
};

// Drives the tuned robot from 20 starts.
Outcome drive_all(const std::function<Course(Stream&)>& draw, const ParamOverrides& changed = {}) {
  ParamOverrides parameters = tuned_parameters("dmrp.controller.e3mop");
  for (const auto& [key, value] : changed) parameters[key] = value;
  Stream random(23, "starts");
  Outcome outcome;
  for (int i = 0; i < starts; ++i) {
    const Drive drive = run("dmrp.controller.e3mop", draw(random), parameters);
    outcome.arrived += drive.arrived;
    outcome.static_clearance_m = std::min(outcome.static_clearance_m, drive.static_clearance_m);
    outcome.walker_clearance_m = std::min(outcome.walker_clearance_m, drive.walker_clearance_m);
  }
  return outcome;
}

dmrp_pose jittered(dmrp_pose pose, Stream& random) {
  return {pose.x + random.uniform(-0.1, 0.1), pose.y + random.uniform(-0.1, 0.1),
          pose.theta + random.uniform(-0.2, 0.2)};
}

// A person steps before the robot, 1.3 m ahead and a little aside, and stays there.
Course person_appears(Stream& random) {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {12.0, 0.0}});
  course.start = jittered({0.0, 0.0, 0.0}, random);
  const double aside_m = random.uniform(-0.1, 0.1);
  const auto place = std::make_shared<dmrp_vec2>(dmrp_vec2{0.0, 50.0});
  Walker person;
  person.at = [place, aside_m](double, dmrp_vec2 robot) {
    if (place->y == 50.0 && robot.x > 4.0) *place = {robot.x + 1.3, robot.y + aside_m};
    return *place;
  };
  person.velocity = [] { return dmrp_vec2{0.0, 0.0}; };
  course.walkers = {person};
  course.time_limit_s = 40.0;
  return course;
}

// A millimetre to two centimetres from a wall 0.2 m thick, and facing it; the path leads to its other side.
Course at_contact(Stream& random) {
  Course course;
  course.boxes = {{{-6.0, 0.0}, {0.5, 0.2}}};
  course.start = {random.uniform(-0.5, 0.5), -course.body.radius_m - random.uniform(0.001, 0.02),
                  random.uniform(0.6, 2.4)};
  course.path = {{course.start.x, course.start.y}, {1.0, -0.4}, {1.0, 0.8}, {-2.0, 0.8}};
  course.time_limit_s = 40.0;
  return course;
}

}  // namespace

TEST_CASE("E3MoP keeps a decimetre from a person who appears before it", "[slow]") {
  const Outcome mended = drive_all(person_appears);
  CHECK(mended.arrived == starts);
  CHECK(mended.walker_clearance_m > 0.1);
  CHECK(drive_all(person_appears, {{"clearance_margin", 0.0}}).walker_clearance_m < 0.06);
}

TEST_CASE("E3MoP leaves a wall that it stands at", "[slow]") {
  const Outcome mended = drive_all(at_contact);
  CHECK(mended.arrived == starts);
  CHECK(mended.static_clearance_m > 0.0);
  CHECK(drive_all(at_contact, {{"leave_padding", false}}).arrived < starts);
}
