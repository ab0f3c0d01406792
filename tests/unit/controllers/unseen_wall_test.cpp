// SPDX-License-Identifier: MIT
// A wall that the plan does not know.
#include "tests/unit/controllers/controllers.hpp"

namespace unseen_wall_test {

using namespace dmrp::test;

TEST_CASE("A path that an unseen wall cuts off ends before it") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  course.boxes = corridor(2.0);
  course.boxes.push_back({{4.0, -1.0}, {4.3, 1.0}});
  course.time_limit_s = 30.0;
  Drive drive = run(controller, course);
  check_sound(drive);
  CHECK_FALSE(drive.arrived);
  CHECK(drive.end.x > 3.0);
  CHECK(drive.turned_rad < 3.5);  // waits, perhaps on its right, and does not swing about

  // and continues once the wall is gone
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s >= 20.0 && now.boxes.size() == 3) now.boxes.pop_back();
  };
  course.time_limit_s = 60.0;
  drive = run(controller, course);
  check_arrives(drive, 35.0);
}

}  // namespace unseen_wall_test
