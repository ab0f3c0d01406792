// SPDX-License-Identifier: MIT
// How E3MoP leaves an obstacle that it stands at, and lets another robot pass: each world is driven from 20 starts.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <functional>

#include "core/execution/collision_monitor.hpp"
#include "tests/unit/controllers/controllers.hpp"

namespace e3mop_freezes_test {

using namespace dmrp::test;
using dmrp::toolkit::Stream;

constexpr int starts = 20;

struct Outcome {
  int arrived = 0;
  double static_clearance_m = 1e9;  // least
};

// Drives the tuned robot from 20 starts.
Outcome drive_all(const std::function<Course(Stream&)>& draw) {
  const ParamOverrides parameters = tuned_parameters("dmrp.controller.e3mop");
  Stream random(23, "starts");
  Outcome outcome;
  for (int i = 0; i < starts; ++i) {
    const Drive drive = run("dmrp.controller.e3mop", draw(random), parameters);
    outcome.arrived += drive.arrived;
    outcome.static_clearance_m = std::min(outcome.static_clearance_m, drive.static_clearance_m);
  }
  return outcome;
}

dmrp_pose jittered(dmrp_pose pose, Stream& random) {
  return {pose.x + random.uniform(-0.1, 0.1), pose.y + random.uniform(-0.1, 0.1),
          pose.theta + random.uniform(-0.2, 0.2)};
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

// It starts beside the end of a shelf, and its path leads round the end.
Course round_shelf(Stream& random) {
  Course course;
  course.boxes = {{{0.9, -0.1}, {2.1, 6.0}}};
  course.start = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-0.05, 0.05)};
  course.path = metre_path({{0.0, 0.0}, {0.0, -1.0}, {4.0, -1.0}});
  course.sight = Sight::scan;
  return course;
}

// Pairs of robots that pass each other head-on in corridors 1.25 to 1.45 m wide; counts at most one that does not.
int pairs_that_pass(bool keeps_right, bool tracking) {
  ParamOverrides parameters = tuned_parameters("dmrp.controller.e3mop");
  parameters["keep_right"] = keeps_right;
  Stream random(29, "corridors");
  for (int round = 0; round < starts; ++round) {
    Course east;
    east.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
    east.start = jittered({0.0, 0.0, 0.0}, random);
    east.boxes = corridor(random.uniform(1.25, 1.45));
    east.sight = Sight::scan;
    east.tracking = tracking;
    east.time_limit_s = 25.0;
    Course west = east;
    west.path = metre_path({{6.0, 0.0}, {0.0, 0.0}});
    west.start = jittered({6.0, 0.0, dmrp::toolkit::pi}, random);
    for (const Drive& drive : drive_two("dmrp.controller.e3mop", east, west, parameters))
      if (!drive.arrived || drive.walker_clearance_m <= 0.0 || drive.static_clearance_m <= 0.0) return round;
  }
  return starts;
}

TEST_CASE("E3MoP leaves a wall that it stands at") {
  const Outcome mended = drive_all(at_contact);
  CHECK(mended.arrived == starts);
  CHECK(mended.static_clearance_m > 0.0);
}

TEST_CASE("E3MoP keeps the gap of a collision monitor at a corner") {
  const Outcome outcome = drive_all(round_shelf);
  CHECK(outcome.arrived == starts);
  CHECK(outcome.static_clearance_m >= dmrp::core::monitor_gap_m);
}

TEST_CASE("Two E3MoP robots pass each other in a corridor where each has to keep to its wall") {
  const bool tracking = GENERATE(true, false);
  CAPTURE(tracking);
  CHECK(pairs_that_pass(true, tracking) == starts);
  CHECK(pairs_that_pass(false, tracking) < starts);
}

}  // namespace e3mop_freezes_test
