// SPDX-License-Identifier: MIT
// The contract for the library and for an instance.
#include <malloc.h>

#include <cmath>
#include <cstring>
#include <dmrp/toolkit/angle.hpp>

#include "tests/unit/controllers/controllers.hpp"

namespace contract_test {

using namespace dmrp::test;

// Walls, a standing and a crossing person, a replan.
Course eventful() {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}});
  course.boxes = {{{-2.0, 1.2}, {4.5, 1.4}}, {{-2.0, -1.4}, {8.0, -1.2}}, {{7.4, -1.2}, {7.6, 6.0}}};
  course.walkers = {standing({3.0, 0.1}), walking({8.0, 2.0}, {0.0, 2.5}, 1.2, 6.0)};
  course.change = [](Course& now, double t_s, const dmrp_pose&) {
    if (t_s < 9.0 || now.revision > 1) return;
    now.revision = 2;
    now.path = metre_path({{5.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}});
  };
  course.time_limit_s = 40.0;
  return course;
}

const std::vector<std::string> drive_holonomic_robots = {
    "dmrp.controller.dwa", "dmrp.controller.mppi",         "dmrp.controller.orca",         "dmrp.controller.teb",
    "dmrp.controller.mpc", "dmrp.controller.pure_pursuit", "dmrp.controller.stop_and_wait"};
const std::vector<std::string> drive_car_like_robots = {"dmrp.controller.teb", "dmrp.controller.mpc",
                                                        "dmrp.controller.pure_pursuit"};

bool same_bits(const Drive& a, const Drive& b) {
  if (a.commands.size() != b.commands.size()) return false;
  for (std::size_t i = 0; i < a.commands.size(); ++i)
    if (std::memcmp(&a.commands[i], &b.commands[i], sizeof(dmrp_command)) != 0) return false;
  return true;
}

TEST_CASE("The library describes its controllers") {
  const PluginLibrary& library = PluginLibrary::load("libdmrp_controllers.so");
  for (const Controller& controller : all_controllers()) {
    CAPTURE(controller);
    const dmrp_descriptor* descriptor = library.find(controller.id);
    REQUIRE(descriptor);
    CHECK(descriptor->kind == DMRP_KIND_LOCAL_CONTROLLER);
    CHECK(std::string(descriptor->license) == "MIT");
    const auto is_one_of = [&](const std::vector<std::string>& ids) {
      return std::find(ids.begin(), ids.end(), controller.id) != ids.end();
    };
    CHECK((dmrp::test::traits_of<dmrp_controller_traits>(*descriptor).kinematics &
           1u << DMRP_KINEMATICS_DIFFERENTIAL) != 0);
    CHECK(((dmrp::test::traits_of<dmrp_controller_traits>(*descriptor).kinematics & 1u << DMRP_KINEMATICS_HOLONOMIC) !=
           0) == is_one_of(drive_holonomic_robots));
    CHECK(((dmrp::test::traits_of<dmrp_controller_traits>(*descriptor).kinematics & 1u << DMRP_KINEMATICS_ACKERMANN) !=
           0) == is_one_of(drive_car_like_robots));
    CHECK(descriptor->flags == (controller.reverses ? DMRP_FLAG_BACKWARDS : 0u));
    for (std::uint32_t i = 0; i < descriptor->param_count; ++i) {
      const dmrp_param_spec& spec = *DMRP_AT(dmrp_param_spec, descriptor->params, descriptor->param_stride, i);
      CAPTURE(spec.key);
      CHECK(std::strlen(spec.doc) > 0);
      if (spec.type == DMRP_PARAM_DOUBLE) {
        CHECK(std::strlen(spec.unit) > 0);
        CHECK(spec.minimum <= spec.number);
        CHECK(spec.number <= spec.maximum);
      }
    }
  }
}

TEST_CASE("A controller without a required extension does not start, without an optional one it drives") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {3.0, 0.0}});
  course.costmap = false;
  const PluginLibrary& library = PluginLibrary::load("libdmrp_controllers.so");
  if (library.find(controller.id)->needed_count > 0) {
    Trip trip(controller.id, course, controller.tuned);
    CHECK(trip.result().breaches == std::vector<std::string>{"start() failed"});
  } else {
    check_arrives(run(controller, course), 10.0);
  }
}

TEST_CASE("Controllers drive with their default parameters") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  check_arrives(run(controller.id, course), 25.0);  // nav2 ships MPPI for 0.5 m/s
}

TEST_CASE("Annotations do not change the commands") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Course course = eventful();
  const Drive silent = run(controller, course);
  course.annotate = true;
  Trip trip(controller.id, course, controller.tuned);
  while (!trip.finished()) trip.control_period();
  CHECK(same_bits(silent, trip.result()));
  const auto& said = trip.notes().trajectories;
  const auto is_prediction = [](const ArenaNotes::Trajectory& t) { return t.role == DMRP_ANNOTATE_PREDICTED; };
  CHECK(std::any_of(said.begin(), said.end(), is_prediction));
  for (const ArenaNotes::Trajectory& trajectory : said) {
    REQUIRE(trajectory.step_ns > 0);
    REQUIRE(trajectory.poses.size() >= 2);
    for (const dmrp_pose& pose : trajectory.poses)
      REQUIRE((std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.theta)));
  }
}

TEST_CASE("DWA annotates all samples, including the chosen one") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {2.0, 0.0}});
  course.annotate = true;
  Trip trip("dmrp.controller.dwa", course, {{"vx_samples", 4}, {"vth_samples", 6}});
  trip.control_period();
  trip.control_period();
  const auto& said = trip.notes().trajectories;
  // from rest: v 0 to 0.1 m/s, omega with zero between
  REQUIRE(said.size() == 2 * (4 * 7 + 1));
  for (const std::size_t chosen : {said.size() / 2 - 1, said.size() - 1}) {
    CHECK(said[chosen].role == DMRP_ANNOTATE_PREDICTED);
    int alike = 0;
    for (std::size_t i = chosen - 28; i < chosen; ++i) {
      CHECK(said[i].role == DMRP_ANNOTATE_CANDIDATE);
      alike += said[i].poses.back().x == said[chosen].poses.back().x &&
               said[i].poses.back().y == said[chosen].poses.back().y;
    }
    CHECK(alike >= 1);
  }
}

TEST_CASE("DWA without the dynamic window samples all velocities reachable within the simulated time") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  course.boxes = corridor(2.4, -2.0, 6.0);
  course.boxes.front().upper.x = 2.8;
  check_arrives(run("dmrp.controller.dwa", course, {{"use_dwa", false}, {"occdist_scale", 0.001}}), 25.0);
}

TEST_CASE("The same course gives the same bits: fresh, started again, and interleaved with other instances") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  const Course course = eventful();
  const Drive once = run(controller, course);
  CHECK(once.breaches == std::vector<std::string>{});
  CHECK(same_bits(once, run(controller, course)));

  // an instance reused after an interrupted trial
  Trip again(controller.id, course, controller.tuned);
  for (int k = 0; k < 60; ++k) again.control_period();
  again.start();
  while (!again.finished()) again.control_period();
  CHECK(same_bits(once, again.result()));

  Course other;
  other.path = metre_path({{1.0, 5.0}, {1.0, 1.0}});
  other.walkers = {standing({1.2, 3.0})};
  Trip one(controller.id, course, controller.tuned);
  Trip two(controller.id, other, controller.tuned);
  Trip three(controller.id, course, controller.tuned);
  while (!one.finished()) {
    one.control_period();
    if (!two.finished()) two.control_period();
    three.control_period();
  }
  CHECK(same_bits(once, one.result()));
  CHECK(same_bits(once, three.result()));
}

TEST_CASE("Memory does not grow from trial to trial") {
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  Trip trip(controller.id, eventful(), controller.tuned);
  const auto bytes_after = [&trip](int trials) {
    for (int i = 0; i < trials; ++i) {
      trip.start();
      for (int k = 0; k < 10; ++k) trip.control_period();
    }
    trip.start();
    const struct mallinfo2 heap = mallinfo2();
    return static_cast<double>(heap.uordblks + heap.hblkhd);
  };
  const double few = bytes_after(3);
  CHECK(bytes_after(12) < few + 65536.0);
}

TEST_CASE("A robot that is already too close to an obstacle moves away from it") {
  // a person stands 0.02 m beside the robot
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}});
  course.walkers = {standing({0.0, 0.57})};
  course.time_limit_s = 20.0;
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  const Drive drive = run(controller, course);
  CHECK(drive.arrived);
  CHECK(drive.walker_clearance_m > 0.0);
}

TEST_CASE("A standing robot enclosed by obstacles waits without an error") {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {5.0, 0.0}});
  course.boxes = {{{0.35, -0.5}, {0.45, 0.5}},
                  {{-0.45, -0.5}, {-0.35, 0.5}},
                  {{-0.5, 0.35}, {0.5, 0.45}},
                  {{-0.5, -0.45}, {0.5, -0.35}}};
  course.time_limit_s = 5.0;
  const Controller controller = GENERATE(from_range(all_controllers()));
  CAPTURE(controller);
  const Drive drive = run(controller, course);
  CHECK(drive.breaches == std::vector<std::string>{});
  CHECK_FALSE(drive.arrived);
  CHECK(drive.static_clearance_m > 0.0);
  CHECK(drive.turned_rad < 0.5);
}

}  // namespace contract_test
