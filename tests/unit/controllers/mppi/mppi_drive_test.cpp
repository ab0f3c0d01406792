// SPDX-License-Identifier: MIT
// MPPI in closed loop: what its parameters change.
#include <catch2/catch.hpp>
#include <cstring>
#include <dmrp/toolkit/random.hpp>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/arena.hpp"
#include "tests/unit/controllers/tuned_parameters.hpp"

namespace mppi_drive_test {

using namespace dmrp::test;

constexpr const char* mppi = "dmrp.controller.mppi";
constexpr int starts = draws(20);

ParamOverrides tuned_with(ParamOverrides others) {
  ParamOverrides all = tuned_parameters(mppi);
  for (const auto& [key, value] : others) all[key] = value;
  return all;
}

Course straight() {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
  return course;
}

TEST_CASE("MPPI brakes if every sampled trajectory collides, and drives on once one is free") {
  Course course = straight();
  course.change = [](Course& now, double t_s, const dmrp_pose& pose) {
    if (now.boxes.empty() && t_s > 3.0 && t_s < 8.0) now.boxes = {{{pose.x + 0.6, -2.0}, {pose.x + 0.8, 2.0}}};
    if (t_s > 8.0) now.boxes.clear();
  };
  const Drive drive = run(mppi, course, tuned_parameters(mppi));
  CHECK(drive.breaches == std::vector<std::string>{});
  CHECK(drive.longest_no_solution_s > 0.1);
  CHECK(drive.static_clearance_m > 0.0);
  CHECK(drive.poses[75].x < 3.0);
  CHECK(drive.arrived);
}

TEST_CASE("MPPI drives with either critic of obstacles") {
  const std::vector<std::string> critics = {"ConstraintCritic", "ObstaclesCritic",  "GoalCritic",
                                            "PathAlignCritic",  "PathFollowCritic", "PathAngleCritic"};
  Course course;
  course.path = metre_path({{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}});
  course.boxes = {{{-2.0, 0.6}, {3.3, 4.0}}};
  const Drive drive = run(mppi, course, tuned_with({{"critics", critics}}));
  CHECK(drive.arrived);
  CHECK(drive.static_clearance_m > 0.0);
}

TEST_CASE("MPPI does not start with a critic that there is not") {
  Course course = straight();
  Trip trip(mppi, course, {{"critics", std::vector<std::string>{"CostCritique"}}});
  CHECK(trip.result().breaches == std::vector<std::string>{"start() failed"});
}

TEST_CASE("MPPI drives on from a corner that it has cut") {
  // nearer to the leg before the corner than to the one after it
  Course course;
  course.path = metre_path({{0.5, -0.5}, {0.5, 0.5}, {-5.5, 0.5}});
  course.start = {0.2, 0.1, 2.7};
  course.time_limit_s = 40.0;
  CHECK(run(mppi, course, tuned_parameters(mppi)).arrived);
}

// Within the tolerance of that point, the path goes on; its direction before the point no longer counts. (With
// `sample_forward` the robot leaves even a path that ends there.)
TEST_CASE("MPPI drives on from the point where its path turns back") {
  int arrived = 0;
  dmrp::toolkit::Stream random(31, "starts");
  for (int i = 0; i < starts; ++i) {
    Course course;
    course.path = metre_path({{2.0, 0.0}, {0.0, 0.0}, {2.0, 0.0}});
    course.start = {0.1 + random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 3.14 + random.uniform(-0.2, 0.2)};
    course.time_limit_s = 20.0;
    arrived += run(mppi, course, tuned_with({{"sample_forward", false}})).arrived;
  }
  CHECK(arrived == starts);
}

// As after somebody has stood there. Of samples that drive backward, the mean is a robot that stands.
TEST_CASE("MPPI turns to a goal that it has passed, if it samples no speeds that it may not drive") {
  int arrived = 0;
  int arrived_before = 0;
  dmrp::toolkit::Stream random(37, "starts");
  for (int i = 0; i < starts; ++i) {
    Course course;
    course.path = metre_path({{-1.0, 0.0}, {0.0, 0.0}});
    course.start = {0.3 + random.uniform(-0.1, 0.1), 0.2 + random.uniform(-0.1, 0.1), 0.8 + random.uniform(-0.2, 0.2)};
    course.time_limit_s = 20.0;
    arrived += run(mppi, course, tuned_parameters(mppi)).arrived;
    if (i < 3) arrived_before += run(mppi, course, tuned_with({{"sample_forward", false}})).arrived;
  }
  CHECK(arrived == starts);
  CHECK(arrived_before == 0);
}

TEST_CASE("MPPI knows of agents only if it is to predict them, as nav2 does not") {
  const auto commands = [](bool tracking, bool predicts) {
    Course course = straight();
    course.walkers = {walking({4.0, 4.5}, {4.0, -5.0}, 1.0)};
    course.tracking = tracking;
    const Drive drive = run(mppi, course, tuned_with({{"include_dynamic_obstacles", predicts}}));
    CHECK(drive.arrived);
    CHECK(drive.walker_clearance_m > 0.0);
    return drive.commands;
  };
  const auto same_bits = [](const std::vector<dmrp_command>& a, const std::vector<dmrp_command>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(dmrp_command)) == 0;
  };
  const std::vector<dmrp_command> untracked = commands(false, true);
  CHECK(same_bits(untracked, commands(false, false)));
  CHECK(same_bits(untracked, commands(true, false)));
  CHECK_FALSE(same_bits(untracked, commands(true, true)));
}

}  // namespace mppi_drive_test
