// SPDX-License-Identifier: MIT
// PIBT: its plans are valid or it says that it gave up, and it never gets stuck where its theorem says so.
#include <algorithm>
#include <catch2/catch.hpp>

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

}  // namespace pibt_test
