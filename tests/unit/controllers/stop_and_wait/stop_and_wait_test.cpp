// SPDX-License-Identifier: MIT
// Stop and wait: never leaves its path, stops before what is on it, and nothing else stops it.
#include <catch2/catch.hpp>

#include "tests/unit/controllers/arena.hpp"

namespace stop_and_wait_test {

using namespace dmrp::test;

constexpr const char* stop_and_wait = "dmrp.controller.stop_and_wait";

Course straight() {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  return course;
}

TEST_CASE("Stop and wait turns in place at corners and stays on its path") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 3.0}, {1.0, 3.0}, {3.0, 3.0}});
  const Drive drive = run(stop_and_wait, course);
  CHECK(drive.arrived);
  CHECK(drive.path_deviation_m < 0.06);
  CHECK(drive.turned_rad == Approx(2.0 * 1.5708 + 3.1416).margin(0.3));
}

TEST_CASE("Stop and wait stops before a person on its path and never passes") {
  const double y = GENERATE(0.0, 0.3, -0.5);
  const bool tracking = GENERATE(true, false);
  CAPTURE(y, tracking);
  Course course = straight();
  course.walkers = {standing({4.0, y})};
  course.tracking = tracking;
  course.time_limit_s = 30.0;
  const Drive drive = run(stop_and_wait, course);
  CHECK(drive.breaches == std::vector<std::string>{});
  CHECK_FALSE(drive.arrived);
  CHECK(drive.walker_clearance_m > 0.1);
  CHECK(drive.path_deviation_m < 0.01);
  CHECK(drive.commands.back().v_x == 0.0);
  CHECK(drive.end.x > 2.8);
}

TEST_CASE("Stop and wait rotates around a cycle of cells, however the robots stand at first") {
  // four robots on four cells, and eight around a ninth
  const std::vector<dmrp_vec2> cells =
      GENERATE(std::vector<dmrp_vec2>{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}},
               std::vector<dmrp_vec2>{
                   {0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {2.0, 2.0}, {1.0, 2.0}, {0.0, 2.0}, {0.0, 1.0}});
  const double radius_m = GENERATE(0.25, 0.3);
  const double turned_rad = GENERATE(0.0, 1.9);  // from robot to robot
  CAPTURE(cells.size(), radius_m, turned_rad);
  std::vector<Course> courses;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Course course;
    course.body.radius_m = course.body.inscribed_radius_m = radius_m;
    course.path = {cells[i], cells[(i + 1) % cells.size()]};
    course.start = {cells[i].x, cells[i].y, turned_rad * static_cast<double>(i)};
    course.time_limit_s = 60.0;
    courses.push_back(course);
  }
  for (const Drive& drive : drive_together(stop_and_wait, courses)) {
    CHECK(drive.arrived);
    CHECK(drive.breaches == std::vector<std::string>{});
    CHECK(drive.walker_clearance_m > 0.0);
  }
}

TEST_CASE("Stop and wait keeps stop_distance before a person beside a robot") {
  Course course = straight();
  Walker robot = standing({4.0, 0.3});
  robot.kind = DMRP_AGENT_ROBOT;
  course.walkers = {robot};
  course.time_limit_s = 30.0;
  const Drive alone = run(stop_and_wait, course);
  CHECK(alone.walker_clearance_m > 0.02);
  CHECK(alone.walker_clearance_m < 0.25);
  course.walkers.push_back(standing({4.0, -0.3}));
  const Drive with_person = run(stop_and_wait, course);
  CHECK(with_person.walker_clearance_m > 0.25);
}

TEST_CASE("Stop and wait keeps stop_distance before what is on its path") {
  Course course = straight();
  course.boxes = {{{5.0, -1.0}, {5.2, 1.0}}};
  course.time_limit_s = 20.0;
  for (const double stop_distance_m : {0.2, 0.6}) {
    CAPTURE(stop_distance_m);
    const Drive drive = run(stop_and_wait, course, {{"stop_distance", stop_distance_m}});
    // the footprint's padding, and cells and steps of 0.05 m
    CHECK(drive.end.x == Approx(5.0 - 0.25 - 0.05 - stop_distance_m).margin(0.1));
  }
}

TEST_CASE("Stop and wait is not stopped by what is beside its path or behind the corner") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  course.walkers = {standing({2.0, 0.7}), standing({2.0, -0.7}), standing({4.9, 0.0})};
  const Drive drive = run(stop_and_wait, course);
  CHECK(drive.arrived);
  CHECK(drive.time_s < 17.0);
  CHECK(drive.walker_clearance_m > 0.0);
}

}  // namespace stop_and_wait_test
