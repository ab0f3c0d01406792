// SPDX-License-Identifier: MIT
// Worlds in which DWA stood for ever with its way free, each driven from 20 starts. Without the switch that mends it,
// the robot does not arrive from all of them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/random.hpp>
#include <functional>

#include "tests/support/draws.hpp"
#include "tests/unit/controllers/controllers.hpp"

namespace dwa_freezes_test {

using namespace dmrp::test;

constexpr int starts = draws(20);

// The number of starts from which the tuned robot arrives without touching anything.
int arrivals(const std::function<Course(dmrp::toolkit::Stream&)>& draw, const char* switched_off = nullptr) {
  ParamOverrides parameters = tuned_parameters("dmrp.controller.dwa");
  if (switched_off) parameters.erase(switched_off);
  dmrp::toolkit::Stream random(17, "starts");
  int arrived = 0;
  for (int i = 0; i < starts; ++i) {
    const Drive drive = run("dmrp.controller.dwa", draw(random), parameters);
    arrived += drive.arrived && drive.static_clearance_m > 0.0;
  }
  return arrived;
}

dmrp_pose jittered(dmrp_pose pose, dmrp::toolkit::Stream& random) {
  return {pose.x + random.uniform(-0.1, 0.1), pose.y + random.uniform(-0.1, 0.1),
          pose.theta + random.uniform(-0.2, 0.2)};
}

// Beside the end of a wall 0.1 to 0.4 m thick, at a gap of about the padding, and facing along it; the path leads to
// the wall's other side.
Course wall_end(dmrp::toolkit::Stream& random) {
  constexpr double radius_m = 0.25;
  Course course;
  const double half_m = 0.5 * random.uniform(0.1, 0.4);
  course.boxes = {{{-4.0, -half_m}, {0.0, half_m}}};
  const double away_m = radius_m + random.uniform(0.03, 0.08);
  const double angle = random.uniform(0.4, 0.9);
  course.start = {away_m * std::cos(angle), half_m + away_m * std::sin(angle),
                  angle - 1.57 + random.uniform(-0.2, 0.2)};
  course.path = {{course.start.x, course.start.y}, {0.35, 0.0}, {0.35, -1.0}, {-1.0, -1.0}, {-3.0, -1.0}};
  course.time_limit_s = 60.0;
  return course;
}

// Two robots head-on, each on the other's path, `beside_m` left of the corridor's middle as the first one sees it.
struct HeadOn {
  double width_m = 1.5;
  double length_m = 7.0;
  double beside_m = 0.0;
  dmrp_pose first = {0.0, beside_m, 0.0};
  dmrp_pose second = {length_m, beside_m, dmrp::toolkit::pi};
};

bool pass(const HeadOn& pair, bool leans) {
  ParamOverrides parameters = tuned_parameters("dmrp.controller.dwa");
  parameters["lean_into_gaps"] = leans;
  const dmrp_vec2 west_end = {0.0, pair.beside_m};
  const dmrp_vec2 east_end = {pair.length_m, pair.beside_m};
  Course east;
  east.path = metre_path({west_end, east_end});
  east.boxes = corridor(pair.width_m, -2.0, pair.length_m + 5.0);
  east.start = pair.first;
  east.time_limit_s = pair.length_m + 23.0;
  Course west = east;
  west.path = metre_path({east_end, west_end});
  west.start = pair.second;
  const auto [one, other] = drive_two("dmrp.controller.dwa", east, west, parameters);
  return one.arrived && other.arrived && one.walker_clearance_m > 0.0 && one.static_clearance_m > 0.0;
}

TEST_CASE("DWA drives a path that steps aside and comes back") {
  const auto draw = [](dmrp::toolkit::Stream& random) {
    Course course;
    course.path = metre_path({{0.0, 0.0}, {1.0, 0.0}, {0.0, 0.0}, {0.0, -4.0}});
    course.start = jittered({0.0, 0.0, 0.0}, random);
    course.time_limit_s = 40.0;
    return course;
  };
  CHECK(arrivals(draw) == starts);
  CHECK(arrivals(draw, "enforce_path_inversion") < starts);
}

TEST_CASE("DWA returns to a path that its window does not hold") {
  const auto draw = [](dmrp::toolkit::Stream& random) {
    Course course;
    course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
    course.start = jittered({0.0, 3.5, 0.0}, random);
    course.time_limit_s = 40.0;
    return course;
  };
  CHECK(arrivals(draw) == starts);
  CHECK(arrivals(draw, "return_to_path") == 0);
}

TEST_CASE("DWA leaves the end of a wall that it stands beside") {
  CHECK(arrivals(wall_end) == starts);
  CHECK(arrivals(wall_end, "leave_padding") < starts);
}

TEST_CASE("Two DWA robots pass each other where neither could pass the other in the middle") {
  const auto passes_with = [](bool leans) {
    dmrp::toolkit::Stream random(23, "head-on");
    int passed = 0;
    for (int i = 0; i < starts; ++i) {
      HeadOn pair;
      pair.width_m = random.uniform(1.5, 1.6);
      pair.first = jittered(pair.first, random);
      pair.second = jittered({7.0, 0.0, 3.14}, random);
      passed += pass(pair, leans);
    }
    return passed;
  };
  CHECK(passes_with(true) == starts);
  CHECK(passes_with(false) < starts / 2);
}

// Beside the middle, the wider side is the same one for both.
TEST_CASE("Two DWA robots exactly in line pass each other, in the middle and beside it") {
  const auto passes_with = [](bool leans) {
    int passed = 0;
    for (const double width_m : {1.45, 1.5, 1.6, 1.8})
      for (const double length_m : {7.0, 11.0})
        for (const double beside_m : {0.0, 0.05}) passed += pass({width_m, length_m, beside_m}, leans);
    return passed;
  };
  CHECK(passes_with(true) == 16);
  CHECK(passes_with(false) < 12);
}

TEST_CASE("DWA has a command where it can stop before what appears ahead") {
  const auto longest_without_command_s = [](bool brakes) {
    ParamOverrides parameters = tuned_parameters("dmrp.controller.dwa");
    parameters["brake_in_time"] = brakes;
    dmrp::toolkit::Stream random(29, "sudden");
    double longest_s = 0.0;
    for (int i = 0; i < starts; ++i) {
      Course course;
      course.path = metre_path({{0.0, 0.0}, {8.0, 0.0}});
      course.start = jittered({0.0, 0.0, 0.0}, random);
      course.time_limit_s = 4.0;
      const double gap_m = random.uniform(0.55, 0.9);  // it stops within 0.32 m
      course.change = [gap_m, appeared = false](Course& now, double t_s, const dmrp_pose& pose) mutable {
        if (appeared || t_s < 2.0) return;
        appeared = true;
        const double from_x = pose.x + 0.25 + gap_m;
        now.boxes = {{{from_x, -2.0}, {from_x + 0.2, 2.0}}};
      };
      const Drive drive = run("dmrp.controller.dwa", course, parameters);
      CHECK(drive.static_clearance_m > 0.0);
      longest_s = std::max(longest_s, drive.longest_no_solution_s);
    }
    return longest_s;
  };
  CHECK(longest_without_command_s(true) == 0.0);
  CHECK(longest_without_command_s(false) > 0.3);
}

TEST_CASE("DWA turns at a right angle of a path that weighs most") {
  const auto arrivals_with = [](bool leaves_path) {
    dmrp::toolkit::Stream random(19, "corner");
    int arrived = 0;
    for (int i = 0; i < starts; ++i) {
      Course course;
      const double corner_m = random.uniform(3.0, 5.0);
      course.path = metre_path({{0.0, 0.0}, {corner_m, 0.0}, {corner_m, 4.0}});
      course.start = jittered({0.0, 0.0, 0.0}, random);
      course.time_limit_s = 60.0;
      const ParamOverrides parameters = {
          {"sim_time", 1.0},      {"vx_samples", int64_t{20}},      {"path_distance_bias", 5.0},
          {"occdist_scale", 2.0}, {"forward_point_distance", 0.28}, {"leave_path_if_stalled", leaves_path}};
      arrived += run("dmrp.controller.dwa", course, parameters).arrived;
    }
    return arrived;
  };
  CHECK(arrivals_with(true) == starts);
  CHECK(arrivals_with(false) < starts);
}

}  // namespace dwa_freezes_test
