// SPDX-License-Identifier: MIT
// Paths that lead through the closed end of a dead end, each driven from 20 starts: the way out leads back, and the
// place beyond leaves the costmap's window meanwhile.
#include <catch2/catch.hpp>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/controllers/controllers.hpp"

namespace dead_ends_test {

using namespace dmrp::test;

constexpr int starts = 20;

// Of walls 0.2 m thick, 1.9 to 2.2 m deep and 1.8 to 2.6 m wide, which opens toward the robot.
Course dead_end(dmrp::toolkit::Stream& random) {
  Course course;
  course.path = metre_path({{0.0, 0.0}, {12.0, 0.0}});
  course.start = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.2, 0.2)};
  const double from_x = 6.0 - random.uniform(1.9, 2.2);
  const double half_m = random.uniform(0.9, 1.3);
  course.boxes = {{{6.0, -half_m}, {6.2, half_m}},
                  {{from_x, half_m}, {6.2, half_m + 0.2}},
                  {{from_x, -half_m - 0.2}, {6.2, -half_m}}};
  course.sight = Sight::scan;
  course.time_limit_s = 60.0;
  return course;
}

int arrivals(const Controller& controller, const ParamOverrides& changed = {}) {
  ParamOverrides parameters = controller.tuned;
  for (const auto& [key, value] : changed) parameters[key] = value;
  dmrp::toolkit::Stream random(31, "dead ends");
  int arrived = 0;
  for (int i = 0; i < starts; ++i) {
    const Drive drive = run(controller.id, dead_end(random), parameters);
    arrived += drive.arrived && drive.static_clearance_m > 0.0;
  }
  return arrived;
}

TEST_CASE("MPC and TEB leave a dead end that their path leads through") {
  const auto [id, departure] = GENERATE(table<const char*, const char*>(
      {{"dmrp.controller.mpc", "keep_detour"}, {"dmrp.controller.teb", "take_detour"}}));
  CAPTURE(id);
  CHECK(arrivals({id}) == starts);
  CHECK(arrivals({id}, {{departure, false}}) < starts);
}

}  // namespace dead_ends_test
