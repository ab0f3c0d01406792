// SPDX-License-Identifier: MIT
// Basic behaviour of all controllers in closed loop: the robot arrives, touches nothing and respects the limits.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/controllers.hpp"

namespace behaviour_test {

using namespace dmrp::test;

TEST_CASE("A straight corridor is driven straight and at full speed") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {10.0, 0.0}});
  course.boxes = corridor(2.0);
  const Drive drive = run(controller, course);
  check_arrives(drive, 17.0);  // 12.5 s at full speed, 0.8 s for speeding up and braking, 0.5 s to settle
  CHECK(drive.path_deviation_m < 0.05);
  CHECK(drive.turned_rad < 0.1);
}

TEST_CASE("A corner between walls") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}});
  course.boxes = {{{-2.0, -1.2}, {6.2, -1.0}}, {{6.0, -1.0}, {6.2, 7.0}}, {{-2.0, 1.0}, {4.0, 7.0}}};
  const Drive drive = run(controller, course);
  check_arrives(drive, 18.0);
  CHECK(drive.turned_rad < 2.5);
}

TEST_CASE("A doorway 0.3 m wider than the robot") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = {{{3.5, 0.4}, {3.7, 5.0}}, {{3.5, -5.0}, {3.7, -0.4}}};
  check_arrives(run(controller, course), 16.0);
}

TEST_CASE("A door of 1.2 m two metres behind a corner") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  course.boxes = {{{-2.0, 1.95}, {3.4, 2.1}}, {{4.6, 1.95}, {9.0, 2.1}}};
  check_arrives(run(controller, course), 16.0);
}

TEST_CASE("A U-turn around the end of a wall") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}, {5.0, 2.0}, {0.0, 2.0}});
  course.boxes = {{{-2.0, 0.9}, {4.0, 1.1}}};
  const Drive drive = run(controller, course);
  check_arrives(drive, 22.0);
  CHECK(drive.turned_rad < 4.5);
}

TEST_CASE("A start that faces away turns in place") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.start = {0.0, 0.0, dmrp::toolkit::pi};
  course.boxes = corridor(1.2);
  const Drive drive = run(controller, course);
  check_arrives(drive, 18.0);
  // MPPI, whose samples drive forward alone, moves by 0.1 m meanwhile
  for (const dmrp_pose& pose : drive.poses) REQUIRE(pose.x > -0.15);
}

TEST_CASE("A start before a wall that faces any way") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}});
  course.boxes = {{{-0.7, -4.0}, {-0.5, 4.0}}};
  constexpr int headings = draws(64);
  for (int i = 0; i < headings; ++i) {
    course.start.theta = dmrp::toolkit::pi * (2.0 * i / headings - 1.0) + 0.02;
    CAPTURE(course.start.theta);
    check_arrives(run(controller, course), 20.0);
  }
}

TEST_CASE("A goal that is to be met to the centimetre, and whose heading") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {3.0, 0.0}});
#ifdef DMRP_FEWER_DRAWS
  const std::vector<double> tolerances_m = {0.05};
#else
  const std::vector<double> tolerances_m = {0.02, 0.05, 0.1, 0.15, 0.2};
#endif
  for (const double tolerance_m : tolerances_m)
    for (const double heading : {double(NAN), 0.0, 1.5, 2.0, -3.0}) {
      course.goal_tolerance_m = tolerance_m;
      course.goal_heading = heading;
      CAPTURE(tolerance_m, heading);
      check_arrives(run(controller, course), 20.0);
    }
}

TEST_CASE("A goal right before a wall is reached without touching it") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}});
  course.boxes = {{{5.4, -3.0}, {5.6, 3.0}}};
  SECTION("with any heading") {
    check_arrives(run(controller, course), 13.0);
  }
  SECTION("facing back") {
    course.goal_heading = dmrp::toolkit::pi;
    const Drive drive = run(controller, course);
    check_arrives(drive, 18.0);
    CHECK(drive.turned_rad < 4.0);  // once, without swinging
  }
}

TEST_CASE("A goal beside a wall") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}});
  course.boxes = {{{2.0, 0.4}, {8.0, 0.6}}};
  check_arrives(run(controller, course), 13.0);
}

TEST_CASE("An unplanned obstacle on the path, with room beside it") {
  const Controller controller = GENERATE(from_range(evading_controllers()));
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.sight = Sight::scan;
  SECTION("a crate in the open") {
    course.boxes = {{{3.7, -0.3}, {4.3, 0.4}}};
  }
  SECTION("half a corridor, closed") {
    course.boxes = corridor(2.4);
    course.boxes.push_back({{3.8, -1.2}, {4.2, 0.1}});
  }
  // the 2 m of path that DWA looks at end in the obstacle: past it, DWA needs a local route
  if (controller.id == "dmrp.controller.dwa") return;
  CAPTURE(controller);
  check_arrives(run(controller, course), has_critics_alone(controller) ? 30.0 : 22.0);
}

TEST_CASE("A path replaced while driving") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s < 4.0 || now.revision > 1) return;
    now.revision = 2;
    now.path = metre_path({{2.0, 0.0}, {2.0, 4.0}, {6.0, 4.0}});
  };
  const Drive drive = run(controller, course);
  check_arrives(drive, 30.0);
  CHECK(drive.end.x == Approx(6.0).margin(0.2));
  CHECK(drive.end.y == Approx(4.0).margin(0.2));
}

TEST_CASE("A replan to the same goal during the final turn does not restart the approach") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}});
  course.goal_heading = dmrp::toolkit::pi;
  course.change = [](Course& now, double, const dmrp_pose& pose) {
    if (pose.x < 3.9) return;
    ++now.revision;  // every control period
    now.path = {{pose.x, pose.y}, {4.0, 0.0}};
  };
  const Drive drive = run(controller, course);
  check_arrives(drive, 16.0);
  CHECK(drive.turned_rad < 4.0);
}

TEST_CASE("Waits in a path do not stop a free robot") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = {{0.0, 0.0}, {0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}};
  check_arrives(run(controller, course), 9.0);
}

TEST_CASE("The last released waypoint is not passed before it is released") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.released = 3;
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s >= 15.0) now.released = 8;
  };
  const Drive drive = run(controller, course);
  check_arrives(drive, 27.0);
  for (std::size_t k = 0; k <= 150; ++k) REQUIRE(drive.poses[k].x < 3.05);
  CHECK(drive.poses[150].x > 2.85);
  CHECK(drive.commands[149].v_x == 0.0);
}

TEST_CASE("An excursion of the path is not skipped") {
  // out and back by one cell: under ordered execution, other robots wait until the robot has been there
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}, {3.0, 0.0}, {6.0, 0.0}});
  course.released = 5;  // the tip of the excursion
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s >= 20.0) now.released = 10;
  };
  const Drive drive = run(controller, course);
  check_arrives(drive, 45.0);
  CHECK(drive.poses[200].y > 1.8);
}

TEST_CASE("A single waypoint, as waypoint dispatch sends it") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = {{3.0, 2.0}};
  check_arrives(run(controller, course), 12.0);
}

TEST_CASE("DWA reaches its goal with the weights of the paper and of its released code") {
  // the path weighs more than the goal: the nose beyond the path's end must not stop the robot short of it
  const double goal_distance_bias = GENERATE(0.8, 1.0);
  const double y = GENERATE(0.0, 0.013, 0.025);  // where in a cell the path runs
  CAPTURE(goal_distance_bias, y);
  Course course;
  course.path = metre_path({{0.0, y}, {4.0, y}, {4.0, y + 3.0}, {5.0, y + 3.0}});
  check_arrives(
      run("dmrp.controller.dwa", course, {{"path_distance_bias", 5.0}, {"goal_distance_bias", goal_distance_bias}}),
      30.0);
}

}  // namespace behaviour_test
