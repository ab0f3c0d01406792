// SPDX-License-Identifier: MIT
// PIBT: its plans are valid or it says that it gave up, and it never gets stuck where its theorem says so.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/random_case.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace pibt_test {

using namespace dmrp::test;

const char* const library = "libdmrp_planners.so";
const char* const pibt = "dmrp.planner.pibt";

TEST_CASE("PIBT's plans of random small problems are valid, and it proves nothing wrong") {
  PluginUnderTest planner(library, pibt, {{"step_limit", 300}});
  int solved = 0;
  int given_up = 0;
  for (uint64_t seed = 0; seed < 800; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = random_case(seed);
    const std::optional<int> optimum = JointSearch(c).optimum();
    const Plan plan = run_planner(planner, c);
    if (!optimum) {
      REQUIRE(plan.status != DMRP_OK);
      continue;
    }
    REQUIRE(plan.status != DMRP_NO_SOLUTION);
    REQUIRE(plan.statistics.at("lower_bound") <= *optimum);
    if (plan.status == DMRP_TIMEOUT) {
      ++given_up;
      continue;
    }
    ++solved;
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.cost() >= *optimum);
    REQUIRE(plan.statistics.at("cost") == plan.cost());
  }
  CHECK(solved > 600);
  CHECK(given_up < solved / 10);
}

TEST_CASE("PIBT brings each robot to its goal where every edge is part of a ring, and its swap where none is") {
  SECTION("a crowd on open ground") {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      CAPTURE(seed);
      Random random(seed);
      PlanningCase c(std::vector<std::string>(10, "............"));
      scatter(c, random, 60);
      const Plan plan = run_planner(pibt, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
    }
  }
  SECTION("two robots that change places in a corridor with a bay") {
    PlanningCase c({".......", "###.###"});
    const Plan plan = run_planner(pibt, c.robot({0, 0}, {{6, 0}}).robot({6, 0}, {{0, 0}}));
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
  }
}

TEST_CASE("PIBT gives up after its steps or at a stop, and gives the same bits for the same seed") {
  PlanningCase c({"....."});
  const Plan plan = run_planner(pibt, c.robot({0, 0}, {{4, 0}}), {{"step_limit", 3}});
  CHECK(plan.status == DMRP_TIMEOUT);
  CHECK(plan.statistics.at("lower_bound") == 4);
  PluginUnderTest endless(library, pibt, {{"step_limit", 10'000'000}});
  check_stop_and_go(endless);

  PluginUnderTest used(library, pibt);
  int differ = 0;
  for (uint64_t seed = 300; seed < 320; ++seed) {
    const PlanningCase crowd = large_case(seed, 60);
    PluginUnderTest fresh(library, pibt);
    const Plan one = run_planner(used, crowd, seed);
    REQUIRE(same_bits(one, run_planner(fresh, crowd, seed)));
    if (one.status == DMRP_OK && !same_bits(one, run_planner(fresh, crowd, seed + 1))) ++differ;
  }
  CHECK(differ > 3);
}

TEST_CASE("of two robots that want the same cell PIBT lets the one go first that has waited for more steps") {
  const int64_t step_ns = PlanningCase::step_duration_ns;
  const auto first_at_door = [](int64_t waited_by_0_ns, int64_t waited_by_1_ns) {
    PlanningCase c({"...", "#.#", "..."});
    c.robot({0, 0}, {{0, 2}}).robot({2, 0}, {{2, 2}});
    c.robots[0].waiting_ns = waited_by_0_ns;
    c.robots[1].waiting_ns = waited_by_1_ns;
    const Plan plan = run_planner(pibt, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    return plan.paths[0].size() < plan.paths[1].size() ? 0 : 1;
  };
  CHECK(first_at_door(0, 0) == 0);
  CHECK(first_at_door(0, step_ns) == 1);
  CHECK(first_at_door(step_ns, 0) == 0);
  CHECK(first_at_door(3 * step_ns, 4 * step_ns) == 1);
  CHECK(first_at_door(0, step_ns - 1) == 0);  // less than a step is none
  CHECK(first_at_door(step_ns, std::numeric_limits<int64_t>::max()) == 1);
}

}  // namespace pibt_test
