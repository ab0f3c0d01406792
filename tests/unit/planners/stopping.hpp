// SPDX-License-Identifier: MIT
// A problem on which searches do not end by themselves, and how planners must stop on it.
#pragma once

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/unit/planners/planning_case.hpp"

namespace dmrp::test {

// Eight robots in a corridor with one bay. They cannot pass each other, and the part is too large for a proof.
inline PlanningCase jammed_case() {
  std::vector<std::string> rows(2, std::string(120, '.'));
  rows[1].assign(120, '#');
  rows[1][60] = '.';
  PlanningCase c(rows);
  for (int i = 0; i < 4; ++i) c.robot({i, 0}, {{119 - i, 0}}).robot({119 - i, 0}, {{i, 0}});
  return c;
}

// Checks that the planner times out at the first request to stop, and that it can plan again afterwards.
inline void check_stop_and_go(PluginUnderTest& planner) {
  int asked = 0;
  planner.host().should_stop = [&] { return ++asked > 100; };
  CHECK(run_planner(planner, jammed_case()).status == DMRP_TIMEOUT);
  CHECK(asked == 101);
  planner.host().should_stop = nullptr;
  PlanningCase easy({"..."});
  easy.robot({0, 0}, {{2, 0}});
  CHECK(run_planner(planner, easy).status == DMRP_OK);
}

}  // namespace dmrp::test
