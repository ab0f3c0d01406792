// SPDX-License-Identifier: MIT
// CBS, ECBS, EECBS and individual shortest paths through the C interface, on small problems written by hand.
#include <catch2/catch.hpp>

#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/planner_variants.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace hand_made_test {

using namespace dmrp::test;

TEST_CASE("one robot takes a shortest path with fewest turns") {
  for (const std::string id : {individual, cbs, ecbs, eecbs}) {
    CAPTURE(id);
    SECTION("on an empty grid: at most one turn, " + id) {
      for (int x = 0; x < 9; x += 2)
        for (int y = 0; y < 7; y += 3) {
          PlanningCase c(std::vector<std::string>(7, "........."));
          c.robot({4, 3}, {{x, y}});
          const Plan plan = run_planner(id, c);
          REQUIRE(plan.status == DMRP_OK);
          REQUIRE(check_plan(c, plan) == "");
          REQUIRE(plan.cost() == std::abs(x - 4) + std::abs(y - 3));
          REQUIRE(turns_of(plan.paths[0]) == (x != 4 && y != 3 ? 1 : 0));
        }
    }
    SECTION("two turns where a staircase would take five, " + id) {
      PlanningCase c({"...##", "....#", "#....", "##..."});
      c.robot({0, 0}, {{4, 3}});
      const Plan plan = run_planner(id, c);
      REQUIRE(plan.status == DMRP_OK);
      CHECK(plan.cost() == 7);
      CHECK(turns_of(plan.paths[0]) == 2);
    }
    SECTION("start is goal, " + id) {
      PlanningCase c({"..."});
      c.robot({1, 0}, {{1, 0}});
      const Plan plan = run_planner(id, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      CHECK(plan.cost() == 0);
    }
    SECTION("around a thin wall, " + id) {
      PlanningCase c({"....", "...."});
      c.thin_wall({1, 0}, {2, 0}).robot({1, 0}, {{2, 0}});
      const Plan plan = run_planner(id, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      CHECK(plan.cost() == 3);
    }
    SECTION("a one-way edge is taken in its direction only, " + id) {
      PlanningCase c({"...", "..."});
      c.close_one_way({1, 0}, {2, 0});
      PlanningCase back = c;
      c.robot({1, 0}, {{2, 0}});
      back.robot({2, 0}, {{1, 0}});
      CHECK(run_planner(id, c).cost() == 3);
      CHECK(run_planner(id, back).cost() == 1);
    }
    SECTION("a tour, " + id) {
      PlanningCase c({".....", ".###.", "....."});
      c.robot({0, 0}, {{4, 0}, {0, 0}, {2, 2}});
      const Plan plan = run_planner(id, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      CHECK(plan.cost() == 4 + 4 + 4);
      CHECK(plan.paths[0].back().goal_index == 3 + 2);
    }
    SECTION("equal goals in a row cost a wait each, " + id) {
      PlanningCase c({"..."});
      c.robot({0, 0}, {{2, 0}, {2, 0}, {2, 0}, {1, 0}});
      const Plan plan = run_planner(id, c);
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      CHECK(plan.cost() == 2 + 2 + 1);
    }
    SECTION("a goal that is cut off, " + id) {
      PlanningCase c({"..#.", "..#."});
      c.robot({0, 0}, {{3, 0}});
      CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
    }
    SECTION("a goal in a wall and one off the map, " + id) {
      PlanningCase in_wall({"..#."});
      in_wall.robot({0, 0}, {{2, 0}});
      CHECK(run_planner(id, in_wall).status == DMRP_NO_SOLUTION);
      PlanningCase outside({"..#."});
      outside.robot({0, 0}, {{-3, 5}});
      CHECK(run_planner(id, outside).status == DMRP_NO_SOLUTION);
    }
    SECTION("no active robot, " + id) {
      PlanningCase c({"..."});
      CHECK(run_planner(id, c).status == DMRP_OK);
      c.robot({1, 0}, {}, DMRP_ROBOT_FINISHED);
      const Plan plan = run_planner(id, c);
      CHECK(plan.status == DMRP_OK);
      CHECK(check_plan(c, plan) == "");
    }
  }
}

TEST_CASE("individual ignores the others") {
  PlanningCase c({"....."});
  c.robot({0, 0}, {{4, 0}}).robot({4, 0}, {{0, 0}}).robot({2, 0}, {}, DMRP_ROBOT_FAILED);
  const Plan plan = run_planner(individual, c);
  REQUIRE(plan.status == DMRP_OK);
  CHECK(check_paths(c, plan) == "");
  CHECK(check_conflicts(c, plan) != "");
  CHECK(plan.cost() == 8);
}

TEST_CASE("conflict-based planners resolve every kind of conflict") {
  const std::string id = GENERATE(cbs, ecbs, eecbs);
  CAPTURE(id);
  const auto plan_best = [&](const PlanningCase& c) {
    return run_planner(id, c, id == cbs ? ParamOverrides{} : ParamOverrides{{"suboptimality", 1.0}});
  };

  SECTION("a swap in a corridor with one bay") {
    PlanningCase c({".......", "###.###"});
    c.robot({0, 0}, {{6, 0}}).robot({6, 0}, {{0, 0}});
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == 6 + 6 + 3);  // into the bay, a wait there, and out again
    CHECK(plan.cost() == JointSearch(c).optimum());
  }
  SECTION("a goal that blocks another's only way: the robot there comes late or steps aside") {
    PlanningCase c({"....", "#.##", "#.##"});
    c.robot({3, 0}, {{1, 1}}).robot({0, 0}, {{1, 2}});
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == JointSearch(c).optimum());
  }
  SECTION("a robot at its goal gives way and comes back") {
    PlanningCase c({".....", "##.##"});
    c.robot({2, 0}, {{2, 0}}).robot({0, 0}, {{4, 0}});
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == 4 + 3);
  }
  SECTION("four robots turn in a ring without a free cell beside") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{1, 1}}).robot({1, 1}, {{0, 1}}).robot({0, 1}, {{0, 0}});
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == 4);
  }
  SECTION("robots that rest are obstacles") {
    PlanningCase c({"...", "...", "..."});
    c.robot({0, 1}, {{2, 1}}).robot({1, 1}, {}, DMRP_ROBOT_FINISHED);
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == 4);
  }
  SECTION("in a corridor one robot follows another on its tour, to a goal that the other crosses before") {
    PlanningCase c({".....", "####."});
    c.robot({0, 0}, {{4, 0}, {0, 0}}).robot({4, 1}, {{2, 0}});
    const Plan plan = plan_best(c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == 8 + 7);  // the second moves when the first turns back, one step behind it
  }
}

TEST_CASE("conflict-based planners prove that there is no plan") {
  const std::string id = GENERATE(cbs, ecbs, eecbs);
  CAPTURE(id);

  SECTION("a swap in a corridor without a bay, however long") {
    PlanningCase c({std::string(200, '.')});
    c.robot({0, 0}, {{199, 0}}).robot({199, 0}, {{0, 0}});
    CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("two robots that end on one cell") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{1, 1}}).robot({2, 0}, {{1, 1}});
    CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("a goal under a robot that rests") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{2, 1}}).robot({2, 1}, {}, DMRP_ROBOT_FAILED);
    CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("a resting robot cuts the map in two") {
    PlanningCase c({"....."});
    c.robot({0, 0}, {{4, 0}}).robot({2, 0}, {}, DMRP_ROBOT_FINISHED);
    CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("two of three robots in a ring would have to swap") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{0, 0}}).robot({1, 1}, {{1, 1}});
    CHECK(run_planner(id, c).status == DMRP_NO_SOLUTION);
  }
}

TEST_CASE("conflict-based planners give up at their limit or when they are stopped") {
  const std::string id = GENERATE(cbs, ecbs, eecbs);
  CAPTURE(id);
  SECTION("by its own limit") {
    const Plan plan = run_planner(id, jammed_case(), {{"node_limit", 50}});
    CHECK(plan.status == DMRP_TIMEOUT);
    CHECK(plan.statistics.at("high_level_generated") > 0);
    CHECK(plan.statistics.at("high_level_generated") <= 52);
  }
  SECTION("by the host") {
    PluginUnderTest planner(planner_library, id);
    check_stop_and_go(planner);
  }
  SECTION("the host is asked often: also by individual") {
    PluginUnderTest planner(planner_library, individual);
    planner.host().should_stop = [] { return true; };
    PlanningCase large(std::vector<std::string>(60, std::string(60, '.')));
    large.robot({0, 0}, {{59, 59}});
    CHECK(run_planner(planner, large).status == DMRP_TIMEOUT);
  }
}

}  // namespace hand_made_test
