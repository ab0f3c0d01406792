// SPDX-License-Identifier: MIT
// LaCAM*, against joint search on small problems, and by the plan check alone on large ones.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/test_data.hpp"
#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/movingai.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/random_case.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace lacam_test {

using namespace dmrp::test;

const char* const library = "libdmrp_planners.so";
const char* const lacam = "dmrp.planner.lacam";

// A problem that is small enough to visit all of its configurations.
PlanningCase tiny_case(uint64_t seed) {
  Random random(seed);
  PlanningCase c({"....", random.one_in(2) ? "#..." : "....", random.one_in(2) ? ".#.#" : "#..."});
  if (random.one_in(3)) c.thin_wall({1, 0}, {2, 0});
  if (random.one_in(4)) c.close_one_way({2, 1}, {1, 1});
  add_random_robots(random, c, 2 + random.below(2), true, true);
  return c;
}

TEST_CASE("LaCAM* run to the end returns the joint optimum, or proves that there is no plan") {
  PluginUnderTest planner(library, lacam, {{"iterations", 0}});
  int unsolvable = 0;
  int broken_rest = 0;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = tiny_case(seed);
    const std::optional<int> optimum = JointSearch(c).optimum();
    const Plan plan = run_planner(planner, c, seed);
    if (!optimum) {
      ++unsolvable;
      REQUIRE(plan.status == DMRP_NO_SOLUTION);
      continue;
    }
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.cost() == *optimum);
    REQUIRE(plan.statistics.at("cost") == *optimum);
    REQUIRE(plan.statistics.at("lower_bound") == *optimum);
    for (std::size_t i = 0; i < plan.paths.size(); ++i) {
      const auto& path = plan.paths[i];
      for (std::size_t t = 0; t + 1 < path.size() && c.robots[i].goals.size() == 1; ++t) {
        const bool at_goal = path[t].x == path.back().x && path[t].y == path.back().y;
        if (at_goal && path[t + 1].x == path[t].x && path[t + 1].y == path[t].y) ++broken_rest;
      }
    }
  }
  CHECK(unsolvable > 20);
  CHECK(broken_rest > 0);  // a robot that rests at its goal and leaves it again pays for the rest
}

TEST_CASE("LaCAM* solves every solvable small problem, and more iterations never make its plan dearer") {
  std::vector<std::pair<int, std::unique_ptr<PluginUnderTest>>> planners;
  for (const int iterations : {1, 100, 2000})
    planners.emplace_back(iterations, std::make_unique<PluginUnderTest>(
                                          library, lacam, ParamOverrides{{"iterations", std::int64_t{iterations}}}));
  int solved = 0;
  int improved = 0;
  for (uint64_t seed = 40'000; seed < 40'300; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = random_case(seed);
    const std::optional<int> optimum = JointSearch(c).optimum();
    int before = 1 << 30;
    for (const auto& [iterations, planner] : planners) {
      CAPTURE(iterations);
      const Plan plan = run_planner(*planner, c);
      REQUIRE((plan.status == DMRP_OK) == optimum.has_value());
      if (!optimum) {
        REQUIRE(plan.status == DMRP_NO_SOLUTION);
        continue;
      }
      REQUIRE(check_plan(c, plan) == "");
      REQUIRE(plan.cost() >= *optimum);
      REQUIRE(plan.statistics.at("lower_bound") <= *optimum);
      REQUIRE(plan.cost() <= before);
      if (before < 1 << 30 && plan.cost() < before) ++improved;
      before = plan.cost();
      ++solved;
    }
  }
  CHECK(solved > 600);
  CHECK(improved > 50);
}

TEST_CASE("LaCAM* solves what needs a swap") {
  SECTION("in a corridor with one bay") {
    PlanningCase c({".......", "###.###"});
    const Plan plan = run_planner(lacam, c.robot({0, 0}, {{6, 0}}).robot({6, 0}, {{0, 0}}));
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
  }
  SECTION("at the branch of a tree") {
    PlanningCase c({".....", "##.##"});
    c.robot({0, 0}, {{4, 0}}).robot({4, 0}, {{0, 0}});
    const Plan plan = run_planner(lacam, c, {{"iterations", 0}});
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
    CHECK(plan.cost() == *JointSearch(c).optimum());
  }
  SECTION("four in a ring without a free cell") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{1, 1}}).robot({1, 1}, {{0, 1}}).robot({0, 1}, {{0, 0}});
    const Plan plan = run_planner(lacam, c);
    REQUIRE(plan.status == DMRP_OK);
    CHECK(plan.cost() == 4);
  }
}

TEST_CASE("LaCAM* plans have no conflicts on crowded grids, and have the same bits for the same seed") {
  PluginUnderTest planner(library, lacam, {{"iterations", 50}});
  int solved = 0;
  int differ = 0;
  for (uint64_t seed = 0; seed < 24; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = large_case(seed, 20 + static_cast<int>(seed % 6) * 50);
    const Plan plan = run_planner(planner, c, seed);
    PluginUnderTest fresh(library, lacam, {{"iterations", 50}});
    REQUIRE(same_bits(plan, run_planner(fresh, c, seed)));
    if (plan.status == DMRP_NO_SOLUTION) continue;  // a goal that is cut off
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    differ += !same_bits(plan, run_planner(fresh, c, seed + 1));
    ++solved;
  }
  CHECK(solved > 8);
  CHECK(differ > 6);
}

TEST_CASE("LaCAM* that is stopped returns the plan that it has, or times out") {
  PluginUnderTest planner(library, lacam, {{"iterations", 0}});
  check_stop_and_go(planner);
  int with_plan = 0;
  int without = 0;
  for (uint64_t seed = 300; seed < 310; ++seed) {
    const PlanningCase c = random_case(seed, 4);
    const bool is_solvable = JointSearch(c).optimum().has_value();
    for (int calls_until_stop = 0; calls_until_stop < 60; ++calls_until_stop) {
      CAPTURE(seed, calls_until_stop);
      int calls = 0;
      planner.host().should_stop = [&] { return ++calls > calls_until_stop; };
      const Plan plan = run_planner(planner, c);
      REQUIRE((plan.status != DMRP_NO_SOLUTION || !is_solvable));
      if (plan.status == DMRP_OK) REQUIRE(check_plan(c, plan) == "");
      with_plan += plan.status == DMRP_OK;
      without += plan.status == DMRP_TIMEOUT;
    }
  }
  CHECK(with_plan > 100);
  CHECK(without > 20);
}

TEST_CASE("LaCAM* plans where prioritized planning jams") {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  PluginUnderTest planner(library, lacam, {{"iterations", 1}});
  const struct {
    const char* map;
    int robots;
  } crowds[] = {{"random-32-32-20", 409}, {"maze-32-32-2", 250}, {"room-32-32-4", 300}, {"maze-128-128-1", 150}};
  for (const auto& crowd : crowds)
    for (int i = 1; i <= 2; ++i) {
      CAPTURE(crowd.map, i);
      const PlanningCase c = read_instance(*data, crowd.map, crowd.robots, i);
      const Plan plan = run_planner(planner, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      REQUIRE(plan.statistics.at("cost") == plan.cost());
    }
}

}  // namespace lacam_test
