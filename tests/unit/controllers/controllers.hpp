// SPDX-License-Identifier: MIT
// controllers.hpp: the only list of the controllers that every behaviour test drives, with their tuned parameters, and
// the checks that all of them must pass.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "tests/unit/controllers/arena.hpp"
#include "tests/unit/controllers/tuned_parameters.hpp"

namespace dmrp::test {

struct Controller {
  std::string id;
  bool evades = true;    // drives around an obstacle on the path; otherwise waits until it leaves
  bool reverses = true;  // may command v < 0 if the limits allow it
  ParamOverrides tuned = tuned_parameters(id);
};

inline std::ostream& operator<<(std::ostream& out, const Controller& controller) {
  return out << controller.id;
}

inline std::vector<Controller> all_controllers() {
  return {{"dmrp.controller.stop_and_wait", false, false},
          {"dmrp.controller.mppi"},
          {"dmrp.controller.orca", false, false},
          {"dmrp.controller.pure_pursuit", false, false},
          {"dmrp.controller.dwa"},
          {"dmrp.controller.teb"},
          {"dmrp.controller.mpc"},
          {"dmrp.controller.e3mop", true, false}};
}

inline std::vector<Controller> evading_controllers() {
  std::vector<Controller> evading = all_controllers();
  evading.erase(std::remove_if(evading.begin(), evading.end(), [](const Controller& c) { return !c.evades; }),
                evading.end());
  return evading;
}

// Those that search no way: only their critics lead them past an obstacle, which takes longer.
inline bool has_critics_alone(const Controller& controller) {
  return controller.id == "dmrp.controller.dwa" || controller.id == "dmrp.controller.mppi";
}

inline Drive run(const Controller& controller, const Course& course) {
  return run(controller.id, course, controller.tuned);
}

inline void check_sound(const Drive& drive) {
  CHECK(drive.breaches == std::vector<std::string>{});
  CHECK(drive.static_clearance_m > 0.0);
}

inline void check_arrives(const Drive& drive, double within_s) {
  check_sound(drive);
  CHECK(drive.arrived);
  CHECK(drive.time_s < within_s);
}

// Horizontal walls 0.2 m thick on both sides of y = 0.
inline std::vector<Box> corridor(double width, double from_x = -2.0, double to_x = 12.0) {
  return {{{from_x, 0.5 * width}, {to_x, 0.5 * width + 0.2}}, {{from_x, -0.5 * width - 0.2}, {to_x, -0.5 * width}}};
}

}  // namespace dmrp::test
