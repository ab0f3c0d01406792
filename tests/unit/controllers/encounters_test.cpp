// SPDX-License-Identifier: MIT
// Local controllers among people and other robots, with and without tracking.
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "tests/unit/controllers/controllers.hpp"

namespace encounters_test {

using namespace dmrp::test;

TEST_CASE("Controllers drive around a person who stands on the path") {
  const Controller controller = GENERATE(from_range(evading_controllers()));
  const bool tracking = GENERATE(true, false);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.tracking = tracking;
  course.walkers = {standing({4.0, 0.0})};
  SECTION("in the open") {}
  SECTION("in a corridor with room on both sides") {
    course.boxes = corridor(2.4);
  }
  SECTION("who stands a little aside") {
    course.walkers = {standing({4.0, 0.25})};
  }
  SECTION("and a second one behind") {
    course.walkers = {standing({3.0, 0.1}), standing({5.5, -0.1})};
  }
  SECTION("seen by the lidar only") {
    course.sight = Sight::scan;
  }
  CAPTURE(controller, tracking);
  const Drive drive = run(controller, course);
  check_arrives(drive, has_critics_alone(controller) ? 45.0 : 25.0);  // DWA takes 41 s, MPPI 37 s
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("Pure pursuit waits for a person on the path and then continues") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.walkers = {walking({4.0, 0.0}, {4.0, 4.0}, 1.0, 15.0)};
  const Drive drive = run("dmrp.controller.pure_pursuit", course);
  check_arrives(drive, 30.0);
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("A person crossing in front") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  const bool tracking = GENERATE(true, false);
  const double from_y = GENERATE(-1.0, 1.0);
  const double start_s = GENERATE(0.0, 1.0);
  CAPTURE(controller, tracking, from_y, start_s);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.tracking = tracking;
  course.walkers = {walking({4.0, 4.0 * from_y}, {4.0, -4.0 * from_y}, 1.2, start_s)};
  const Drive drive = run(controller, course);
  check_arrives(drive, 25.0);
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("A person blocks the path for a while and leaves") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  const bool tracking = GENERATE(true, false);
  CAPTURE(controller, tracking);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = corridor(1.4);  // too narrow to pass
  course.tracking = tracking;
  course.walkers = {{0.3, [](double t_s, dmrp_vec2) -> dmrp_vec2 {
                       if (t_s < 25.0) return {std::max(4.0, 9.0 - 1.2 * t_s), 0.0};
                       return {4.0 + 1.2 * (t_s - 25.0), 0.0};
                     }}};
  const Drive drive = run(controller, course);
  check_arrives(drive, 45.0);
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("A person overtakes and walks on ahead") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  const bool tracking = GENERATE(true, false);
  CAPTURE(controller, tracking);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = corridor(2.4);
  course.tracking = tracking;
  course.walkers = {walking({-3.0, 0.7}, {12.0, 0.7}, 1.2)};
  const Drive drive = run(controller, course);
  check_arrives(drive, 20.0);
  CHECK(drive.own_walker_clearance_m > 0.0);
}

TEST_CASE("Two robots meet head-on in a corridor of 2 m") {
  const Controller controller = GENERATE(from_range(evading_controllers()));
  const bool tracking = GENERATE(true, false);
  const double offset = GENERATE(0.0, 0.1);
  CAPTURE(controller, tracking, offset);
  Course east;
  east.path = metre_path({{0.0, 0.0}, {10.0, 0.0}});
  east.boxes = corridor(2.0);
  east.tracking = tracking;
  east.time_limit_s = 60.0;
  Course west = east;
  west.path = metre_path({{10.0, offset}, {0.0, offset}});
  west.start = {10.0, offset, dmrp::toolkit::pi};

  for (const Drive& drive : drive_two(controller.id, east, west, controller.tuned)) {
    check_arrives(drive, 40.0);
    CHECK(drive.walker_clearance_m > 0.0);
  }
}

// Gives the robot a straight path to its goal, once a second.
void lead_anew(Course& now, double t_s, const dmrp_pose& pose) {
  if (t_s + 0.05 < static_cast<double>(now.revision)) return;
  ++now.revision;
  now.path = {{pose.x, pose.y}, now.path.back()};
}

TEST_CASE("Two robots whose paths cross") {
  const Controller controller = GENERATE(from_range(evading_controllers()));
  const bool tracking = GENERATE(true, false);
  CAPTURE(controller, tracking);
  Course east;
  east.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  east.tracking = tracking;
  east.time_limit_s = 60.0;
  Course north = east;
  north.path = metre_path({{4.0, -4.5}, {4.0, 4.0}});
  north.start = {4.0, -4.5, 0.5 * dmrp::toolkit::pi};
  if (controller.id == "dmrp.controller.e3mop") {
    // it evades alongside the other robot, out of sight of its path: routes have to begin at the robot
    east.change = north.change = lead_anew;
  }

  for (const Drive& drive : drive_two(controller.id, east, north, controller.tuned)) {
    check_arrives(drive, 25.0);
    CHECK(drive.walker_clearance_m > 0.0);
  }
}

}  // namespace encounters_test
