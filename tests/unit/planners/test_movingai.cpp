// SPDX-License-Identifier: MIT
// CBS on instances of the MovingAI benchmark (Stern et al. 2019).
#include <catch2/catch.hpp>

#include "movingai.hpp"
#include "plan_check.hpp"
#include "test_data.hpp"

using namespace dmrp::test;

namespace {

void check_solved(const std::string& map_name, const std::string& folder, int robots, int instances) {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  const auto map = folder == "generated" ? *data / "generated" / (map_name + ".map")
                                         : *data / "movingai" / "maps" / (map_name + ".map");
  PluginUnderTest planner("libdmrp_planners.so", "dmrp.planner.cbs");
  for (int i = 1; i <= instances; ++i) {
    PlanningCase c = read_map(map);
    const std::string scenario = map_name + "-random-" + std::to_string(i) + ".scen";
    add_robots(c, folder == "generated" ? *data / folder / scenario : *data / "movingai" / "scens" / scenario, robots);
    REQUIRE(c.robots.size() == static_cast<std::size_t>(robots));
    CAPTURE(scenario);
    const Plan plan = run_planner(planner, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.statistics.at("cost") == plan.cost());
  }
}

}  // namespace

TEST_CASE("CBS solves 20 robots on random-32-32-20") {
  check_solved("random-32-32-20", "movingai", 20, 5);
}

TEST_CASE("CBS solves 20 robots on 40x40 rooms") {
  check_solved("gen-rooms-40-40", "generated", 20, 5);
}

TEST_CASE("CBS solves 4 robots on 40x40 cells") {
  check_solved("gen-random-40-40-10", "generated", 4, 10);
}
