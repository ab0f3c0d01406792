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

TEST_CASE("DWA leaves the end of a wall that it stands beside") {
  CHECK(arrivals(wall_end) == starts);
  CHECK(arrivals(wall_end, "leave_padding") < starts);
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
