// SPDX-License-Identifier: MIT
#include "host/findings/conditions.hpp"

#include <catch2/catch.hpp>

namespace conditions_test {

using dmrp::host::conditions_words;

TEST_CASE("conditions name what helps controllers, and what is swept", "[findings]") {
  const char* alone =
      "[simulation]\ntracking = 'none'\nreplan_period_s = 0.0\n[navigation]\nroute = 'path'\nmonitor = false\n"
      "[recovery]\nretries = 0\n";
  CHECK(conditions_words(alone, "") ==
        "no local routes, no collision monitor, no recoveries, no replanning, tracking none");

  const char* helped =
      "[simulation]\ntracking = 'visible'\nreplan_period_steps = 5\n[navigation]\nroute = 'around'\nmonitor = true\n"
      "compensate_latency = true\n[recovery]\nretries = 6\n[[pedestrian_model]]\nparams = { robot_awareness = 0.5 }\n";
  const char* written =
      "[[local_controller]]\nparams_file = 'controllers/tuned/dwa.toml'\n[[local_controller]]\nuse = 'mine'\n"
      "[[local_controller]]\nparams_file = './mpc.toml'\n";
  CHECK(conditions_words(helped, written) ==
        "local routes, collision monitor, latency compensated, recoveries, replanning, tracking visible, default and "
        "own and tuned "
        "parameters, "
        "robot awareness 0.5");

  const char* swept =
      "[simulation]\nsweep = { tracking = ['none', 'all'], replan_period_s = [0.0, 2.0] }\n[navigation]\nroute = "
      "'path'\n"
      "sweep = { route = ['path', 'around'] }\n[[pedestrian_model]]\nsweep = { robot_awareness = [0.0, 1.0] }\n";
  CHECK(conditions_words(swept, "") ==
        "local routes swept, no collision monitor, no recoveries, replanning swept, tracking swept, robot awareness "
        "swept");
}

}  // namespace conditions_test
