// SPDX-License-Identifier: MIT
// ORCA's robots among robots, people and walls.
#include <catch2/catch.hpp>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/controllers/controllers.hpp"

namespace orca_drive_test {

using namespace dmrp::test;

constexpr const char* orca = "dmrp.controller.orca";

TEST_CASE("Six of ORCA's robots change places on a circle") {
  constexpr int count = 6;
  std::vector<Course> courses(count);
  for (int i = 0; i < count; ++i) {
    const dmrp_vec2 from = 4.0 * dmrp::toolkit::from_angle(2.0 * dmrp::toolkit::pi * i / count + 0.05 * i);
    Course& course = courses[static_cast<std::size_t>(i)];
    course.path = metre_path({from, -1.0 * from});
    course.start = {from.x, from.y, std::atan2(-from.y, -from.x)};
    course.time_limit_s = 60.0;
  }
  for (const Drive& drive : drive_together(orca, courses)) {
    CHECK(drive.arrived);
    CHECK(drive.breaches == std::vector<std::string>{});
    CHECK(drive.walker_clearance_m > 0.0);
  }
}

TEST_CASE("ORCA's robots keep off walls that their path cuts") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.boxes = {{{2.5, -2.0}, {3.5, -0.15}}};  // 0.1 m into the way of the robot
  const Drive drive = run(orca, course);
  CHECK(drive.arrived);
  CHECK(drive.static_clearance_m > 0.0);
}

TEST_CASE("ORCA gives way to a person who does not") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.walkers = {walking({8.0, 0.1}, {-2.0, 0.1}, 1.0)};
  const Drive drive = run(orca, course);
  CHECK(drive.arrived);
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("ORCA's robots do not orbit a goal close behind a turn") {
  for (int i = 0; i < 16; ++i)
    for (const double side : {-1.0, 1.0}) {
      Course course;
      course.path = metre_path({{0.0, 0.0}, {1.0, 0.0}, {1.0, side}});
      course.start.theta = dmrp::toolkit::pi * (i - 8) / 8.0;
      const Drive drive = run(orca, course);
      CAPTURE(course.start.theta, side);
      CHECK(drive.arrived);
      CHECK(drive.time_s < 20.0);
    }
}

}  // namespace orca_drive_test
