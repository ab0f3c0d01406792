// SPDX-License-Identifier: MIT
// Known failures of the MPC, in closed loop.
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/controllers/controllers.hpp"

using namespace dmrp::test;
using dmrp::toolkit::Stream;

namespace {

const Controller mpc = {"dmrp.controller.mpc"};

// Up to 0.1 m and 0.2 rad beside the pose.
dmrp_pose jittered(dmrp_pose pose, Stream& random) {
  return {pose.x + random.uniform(-0.1, 0.1), pose.y + random.uniform(-0.1, 0.1),
          pose.theta + random.uniform(-0.2, 0.2)};
}

}  // namespace

TEST_CASE("MPC drives around a row of standing people without swinging") {
  const int people = GENERATE(3, 5);
  const bool tracking = GENERATE(true, false);
  Stream random(11, "row");
  for (int round = 0; round < 5; ++round) {
    CAPTURE(people, tracking, round);
    Course course;
    course.start = jittered({0.0, 0.25, 0.0}, random);
    course.path = metre_path({{0.0, 0.25}, {11.0, 0.25}});
    course.tracking = tracking;
    course.sight = Sight::scan;
    for (int i = 0; i < people; ++i) course.walkers.push_back(standing({5.5, 0.6 * (i - 0.5 * (people - 1))}));
    const Drive drive = run(mpc, course);
    check_arrives(drive, 20.0);
    CHECK(drive.walker_clearance_m > 0.0);
    CHECK(drive.turned_rad < 6.0);
  }
}

TEST_CASE("Two MPC robots in contact that see each other separate and pass") {
  Stream random(12, "contact");
  for (int round = 0; round < 10; ++round) {
    CAPTURE(round);
    Course east;
    east.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
    east.boxes = corridor(1.8);
    east.time_limit_s = 60.0;
    Course west = east;
    west.path = metre_path({{6.0, 0.0}, {0.0, 0.0}});
    east.start = jittered({3.0, 0.0, 0.0}, random);
    west.start = {east.start.x + 0.49, east.start.y + random.uniform(-0.05, 0.05), dmrp::toolkit::pi};
    for (const Drive& drive : drive_two(mpc.id, east, west, mpc.tuned)) check_arrives(drive, 40.0);
  }
}
