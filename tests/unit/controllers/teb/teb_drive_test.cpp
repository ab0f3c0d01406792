// SPDX-License-Identifier: MIT
// Known failures of teb_local_planner, in closed loop.
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/controllers.hpp"
#include "tests/unit/controllers/tuned_parameters.hpp"

namespace teb_drive_test {

using namespace dmrp::test;

Controller teb() {
  return {"dmrp.controller.teb"};
}

TEST_CASE("TEB: a robot that starts closer to a wall than min_obstacle_dist leaves it") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.boxes = {{{-1.0, 0.29}, {3.0, 0.5}}};  // 4 cm beside the robot
  course.start.theta = GENERATE(0.0, 0.4, -1.5);
  CAPTURE(course.start.theta);
  check_arrives(run(teb(), course), 13.0);
}

TEST_CASE("TEB: keeps its speed in a free corridor, cycle after cycle") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {10.0, 0.0}});
  course.boxes = corridor(2.0);
  const Drive drive = run(teb(), course);
  check_arrives(drive, 15.0);
  for (std::size_t k = 15; k < 110; ++k) CHECK(drive.commands[k].v_x > 0.75);
}

TEST_CASE("TEB: continues once a path is free again, after many cycles without one") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.boxes = {{{0.4, -0.6}, {0.6, 0.6}},
                  {{-0.6, -0.6}, {-0.4, 0.6}},
                  {{-0.6, 0.4}, {0.6, 0.6}},
                  {{-0.6, -0.6}, {0.6, -0.4}}};  // shut in
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s >= 12.0) now.boxes.clear();
  };
  const Drive drive = run(teb(), course);
  check_arrives(drive, 24.0);
  CHECK(drive.longest_no_solution_s < 1.0);
}

TEST_CASE("TEB: does not spin before an occupied goal") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}});
  course.walkers = {standing({4.0, 0.0})};
  course.tracking = GENERATE(true, false);
  course.time_limit_s = 40.0;
  const Drive drive = run(teb(), course);
  check_sound(drive);
  CHECK(drive.walker_clearance_m > 0.0);
  CHECK(drive.end.x > 2.5);
  CHECK(drive.turned_rad < 6.3);
}

TEST_CASE("TEB: upstream's defaults drive in open space") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}});
  course.walkers = {standing({2.5, -0.1})};
  const Drive drive = run("dmrp.controller.teb", course);
  check_arrives(drive, 25.0);
  CHECK(drive.walker_clearance_m > 0.3);
}

TEST_CASE("TEB: via-points draw the robot along the path") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  Controller free = teb();
  Controller guided = teb();
  guided.tuned["global_plan_viapoint_sep"] = 0.5;
  guided.tuned["weight_viapoint"] = 5.0;
  const Drive a = run(free, course);
  const Drive b = run(guided, course);
  check_arrives(a, 14.0);
  check_arrives(b, 16.0);
  CHECK(b.path_deviation_m < 0.7 * a.path_deviation_m);
}

TEST_CASE("TEB: annotates the chosen band and the others") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}});
  course.walkers = {standing({2.0, 0.1})};
  course.annotate = true;
  const Controller controller = teb();
  Trip trip(controller.id, course, controller.tuned);
  for (int k = 0; k < 10; ++k) trip.control_period();
  int predicted = 0;
  int candidates = 0;
  for (const ArenaNotes::Trajectory& trajectory : trip.notes().trajectories) {
    ++(trajectory.role == DMRP_ANNOTATE_PREDICTED ? predicted : candidates);
    CHECK(trajectory.poses.size() > 2);
    CHECK(trajectory.step_ns > 0);
  }
  CHECK(predicted == 10);
  CHECK(candidates > 0);
  CHECK(trip.notes().notes.size() == 10);
}

TEST_CASE("TEB: reaches goals closer to a table than min_obstacle_dist") {
  int arrived = 0;
  int arrived_without = 0;
  dmrp::toolkit::Stream random(31, "goals");
  for (const double gap_m : {0.05, 0.15, 0.25, 0.35}) {
    for (int i = 0; i < 5; ++i) {
      Course course;
      course.boxes = {{{6.0, 1.0}, {8.0, 2.0}}};
      course.path = metre_path({{2.0, 5.5}, {4.5, 3.0}, {6.5, 2.25 + gap_m}});
      course.start = {2.0 + random.uniform(-0.1, 0.1), 5.5 + random.uniform(-0.1, 0.1), random.uniform(-0.2, 0.2)};
      course.time_limit_s = 30.0;
      const Drive drive = run(teb().id, course);  // with the defaults: min_obstacle_dist is 0.5 m
      check_sound(drive);
      arrived += drive.arrived;
      arrived_without += run(teb().id, course, {{"ease_to_goal", false}}).arrived;
    }
  }
  CHECK(arrived == 20);
  CHECK(arrived_without < 20);
}

// 25 cm for three gaps.
TEST_CASE("TEB: two robots pass each other in a corridor 25 cm wider than both") {
  const int starts = draws(20);
  dmrp::toolkit::Stream random(43, "starts");
  int passed = 0;
  for (int i = 0; i < starts; ++i) {
    Course east;
    east.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
    east.boxes = corridor(1.25);
    east.time_limit_s = 20.0;
    Course west = east;
    west.path = metre_path({{8.0, 0.0}, {0.0, 0.0}});
    const auto displaced = [&random](double x, double theta) {
      const double ahead_m = random.uniform(-0.1, 0.1);
      const double aside_m = random.uniform(-0.1, 0.1);
      return dmrp_pose{x + ahead_m, aside_m, theta + random.uniform(-0.2, 0.2)};
    };
    east.start = displaced(0.0, 0.0);
    west.start = displaced(8.0, dmrp::toolkit::pi);
    const auto drives = drive_two("dmrp.controller.teb", east, west, tuned_parameters("dmrp.controller.teb"));
    passed += drives[0].arrived && drives[1].arrived && drives[0].walker_clearance_m > 0.0;
  }
  CHECK(passed >= starts - starts / 10);
}

}  // namespace teb_drive_test
