// SPDX-License-Identifier: MIT
// ECBS-8 against the joint optimum under its own model of time and conflicts, and its behaviour without a plan.
#include <catch2/catch.hpp>

#include "tests/support/test_data.hpp"
#include "tests/unit/planners/joint_optimum_8.hpp"
#include "tests/unit/planners/movingai.hpp"
#include "tests/unit/planners/plan_check_8.hpp"
#include "tests/unit/planners/random_case.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace ecbs8_test {

using namespace dmrp::test;

const char* const library = "libdmrp_planners.so";
const char* const ecbs8 = "dmrp.planner.ecbs8";

// Cells with up to 30 % of obstacles, except for a corner with room for all robots. Half of the cases have thin walls:
// between two cells, or across a corner only.
PlanningCase random_grid(Random& random, int width, int height) {
  const int obstacles_of_20 = random.below(7);
  std::vector<std::string> rows(static_cast<std::size_t>(height), std::string(static_cast<std::size_t>(width), '.'));
  for (auto& row : rows)
    for (char& c : row)
      if (random.below(20) < obstacles_of_20) c = '#';
  rows[0].replace(0, 4, "....");
  rows[1].replace(0, 4, "....");
  PlanningCase c(rows);
  if (random.one_in(2)) return c;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (x + 1 < width && random.one_in(6)) c.thin_wall({x, y}, {x + 1, y});
      if (y + 1 < height && random.one_in(6)) c.thin_wall({x, y}, {x, y + 1});
      if (x + 1 < width && y + 1 < height && random.one_in(6)) c.thin_wall({x, y}, {x + 1, y + 1});
      if (x > 0 && y + 1 < height && random.one_in(6)) c.thin_wall({x, y}, {x - 1, y + 1});
    }
  return c;
}

PlanningCase small_case(uint64_t seed) {
  Random random(seed);
  const int width = 4 + random.below(3);
  const int height = 4 + random.below(3);
  PlanningCase c = random_grid(random, width, height);
  add_random_robots(random, c, 2 + random.below(2), true, true);
  return c;
}

// Checks a plan that was found, and its bound.
void check_solved(const PlanningCase& c, const Plan& plan, double suboptimality) {
  REQUIRE(plan.status == DMRP_OK);
  REQUIRE(check_plan_8(c, plan) == "");
  REQUIRE(plan.statistics.at("cost") == Approx(cost_8(plan)).epsilon(1e-9));
  REQUIRE(plan.statistics.at("cost") <= suboptimality * plan.statistics.at("lower_bound"));
}

TEST_CASE("ECBS-8 keeps to its bound of the joint optimum on random small problems") {
  PluginUnderTest optimal(library, ecbs8, {{"suboptimality", 1.0}, {"node_limit", 3000}});
  PluginUnderTest near(library, ecbs8, {{"suboptimality", 1.2}, {"node_limit", 3000}});
  PluginUnderTest loose(library, ecbs8, {{"suboptimality", 2.0}, {"node_limit", 3000}});
  const std::vector<std::pair<double, PluginUnderTest*>> planners = {{1.0, &optimal}, {1.2, &near}, {2.0, &loose}};
  int solvable = 0;
  int unsolvable = 0;
  int given_up = 0;
  int dearer = 0;
  for (uint64_t seed = 0; seed < 1500; ++seed) {
    const PlanningCase c = small_case(seed);
    const std::optional<double> optimum = JointSearch8(c).optimum();
    (optimum ? solvable : unsolvable) += 1;
    for (const auto& [suboptimality, planner] : planners) {
      CAPTURE(seed, suboptimality);
      const Plan plan = run_planner(*planner, c);
      if (!optimum) {
        REQUIRE(plan.status == DMRP_NO_SOLUTION);
        continue;
      }
      REQUIRE(plan.statistics.at("lower_bound") <= *optimum + 1e-6);
      if (plan.status == DMRP_TIMEOUT) {
        ++given_up;
        continue;
      }
      check_solved(c, plan, suboptimality);
      REQUIRE(cost_8(plan) >= *optimum - 1e-6);
      REQUIRE(cost_8(plan) <= suboptimality * *optimum + 1e-6);
      if (cost_8(plan) > *optimum + 1e-6) ++dearer;
    }
  }
  // The random cases must contain enough of each kind.
  CHECK(solvable > 1000);
  CHECK(unsolvable > 50);
  CHECK(dearer > 20);
  CHECK(given_up < 15);
}

TEST_CASE("ECBS-8 keeps to its bound of the joint optimum among four robots") {
  for (const double suboptimality : {1.0, 1.2, 2.0}) {
    PluginUnderTest planner(library, ecbs8, {{"suboptimality", suboptimality}, {"node_limit", 3000}});
    int given_up = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
      CAPTURE(seed, suboptimality);
      Random random(seed + 77);
      PlanningCase c({"....", ".#..", "....", "...#"});
      add_random_robots(random, c, 4, false, false);
      const std::optional<double> optimum = JointSearch8(c).optimum();
      const Plan plan = run_planner(planner, c);
      REQUIRE(optimum);
      REQUIRE(plan.statistics.at("lower_bound") <= *optimum + 1e-6);
      if (plan.status == DMRP_TIMEOUT) {
        ++given_up;
        continue;
      }
      check_solved(c, plan, suboptimality);
      REQUIRE(cost_8(plan) <= suboptimality * *optimum + 1e-6);
    }
    CHECK(given_up < 4);
  }
}

TEST_CASE("ECBS-8: twelve robots on 20x20 cells") {
  for (const double suboptimality : {1.2, 2.0}) {
    PluginUnderTest planner(library, ecbs8, {{"suboptimality", suboptimality}});
    int solved = 0;
    for (uint64_t seed = 0; seed < 60; ++seed) {
      CAPTURE(seed, suboptimality);
      Random random(seed + 4000);
      PlanningCase c = random_grid(random, 20, 20);
      add_random_robots(random, c, 12, true, true);
      const Plan plan = run_planner(planner, c);
      if (plan.status == DMRP_NO_SOLUTION) continue;  // a robot is walled in
      check_solved(c, plan, suboptimality);
      ++solved;
    }
    CHECK(solved > 25);
  }
}

TEST_CASE("ECBS-8 describes itself") {
  const dmrp_descriptor* descriptor = PluginLibrary::load(library).find(ecbs8);
  REQUIRE(descriptor);
  CHECK(descriptor->kind == DMRP_KIND_GLOBAL_PLANNER);
  CHECK(dmrp::test::traits_of<dmrp_planner_traits>(*descriptor).connectivity == DMRP_CONNECTIVITY_8);
  CHECK(descriptor->flags == 0);
}

TEST_CASE("ECBS-8: one robot") {
  const double diagonal = std::sqrt(2.0);
  SECTION("diagonals and one turn on an empty grid") {
    for (int x = 0; x < 9; x += 2)
      for (int y = 0; y < 7; y += 3) {
        PlanningCase c(std::vector<std::string>(7, "........."));
        c.robot({4, 3}, {{x, y}});
        const Plan plan = run_planner(ecbs8, c);
        check_solved(c, plan, 1.0);
        const int dx = std::abs(x - 4);
        const int dy = std::abs(y - 3);
        REQUIRE(cost_8(plan) == Approx(std::max(dx, dy) + (diagonal - 1) * std::min(dx, dy)));
        REQUIRE(turns_of(plan.paths[0]) == (dx != dy && dx != 0 && dy != 0 ? 1 : 0));
      }
  }
  SECTION("no corner is cut") {
    PlanningCase c({"..", "#."});
    c.robot({0, 0}, {{1, 1}});
    CHECK(cost_8(run_planner(ecbs8, c)) == Approx(2.0));
  }
  SECTION("start is goal") {
    PlanningCase c({"..."});
    c.robot({1, 0}, {{1, 0}});
    const Plan plan = run_planner(ecbs8, c);
    check_solved(c, plan, 1.0);
    CHECK(plan.paths[0].size() == 1);
  }
  SECTION("around a thin wall") {
    PlanningCase c({"....", "...."});
    c.thin_wall({1, 0}, {2, 0}).thin_wall({1, 1}, {2, 0}).thin_wall({1, 0}, {2, 1}).robot({1, 0}, {{2, 0}});
    const Plan plan = run_planner(ecbs8, c);
    check_solved(c, plan, 1.0);
    CHECK(cost_8(plan) == Approx(3.0));
  }
  SECTION("a one-way edge is taken in its direction only") {
    PlanningCase c({"..", ".."});
    c.close_one_way({0, 0}, {1, 1});
    PlanningCase back = c;
    c.robot({0, 0}, {{1, 1}});
    back.robot({1, 1}, {{0, 0}});
    CHECK(cost_8(run_planner(ecbs8, c)) == Approx(2.0));
    CHECK(cost_8(run_planner(ecbs8, back)) == Approx(diagonal));
  }
  SECTION("a tour") {
    PlanningCase c({".....", ".###.", "....."});
    c.robot({0, 0}, {{4, 0}, {0, 0}, {2, 2}});
    const Plan plan = run_planner(ecbs8, c);
    check_solved(c, plan, 1.0);
    CHECK(cost_8(plan) == Approx(4 + 4 + 4));
    CHECK(plan.paths[0].back().goal_index == 3 + 2);
  }
  SECTION("equal goals in a row cost a wait each") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{2, 0}, {2, 0}, {2, 0}, {1, 1}});
    const Plan plan = run_planner(ecbs8, c);
    check_solved(c, plan, 1.0);
    CHECK(cost_8(plan) == Approx(2 + 2 + diagonal));
  }
  SECTION("no active robot") {
    PlanningCase c({"..."});
    CHECK(run_planner(ecbs8, c).status == DMRP_OK);
    c.robot({1, 0}, {}, DMRP_ROBOT_FINISHED);
    const Plan plan = run_planner(ecbs8, c);
    CHECK(plan.status == DMRP_OK);
    CHECK(check_plan_8(c, plan) == "");
  }
}

TEST_CASE("ECBS-8 resolves every kind of conflict") {
  PluginUnderTest planner(library, ecbs8, {{"suboptimality", 1.0}});
  const auto optimal_cost = [&](const PlanningCase& c) {
    const Plan plan = run_planner(planner, c);
    check_solved(c, plan, 1.0);
    REQUIRE(cost_8(plan) == Approx(JointSearch8(c).optimum().value()));
    return cost_8(plan);
  };
  const double diagonal = std::sqrt(2.0);
  SECTION("a swap in a corridor with one bay") {
    PlanningCase c({".......", "###.###"});
    c.robot({0, 0}, {{6, 0}}).robot({6, 0}, {{0, 0}});
    CHECK(optimal_cost(c) == Approx(6 + 6 + 3));  // into the bay, a wait there, and out again
  }
  SECTION("crossing diagonals: one waits until the other has left its cells") {
    PlanningCase c({"...", "...", "..."});
    c.robot({0, 0}, {{2, 2}}).robot({2, 0}, {{0, 2}});
    CHECK(optimal_cost(c) > 4 * diagonal + 0.5);
  }
  SECTION("a diagonal beside a robot that leaves") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{1, 1}}).robot({1, 0}, {{2, 0}});
    CHECK(optimal_cost(c) == Approx(2 + 1));  // two straight moves are cheaper than a wait and a diagonal
  }
  SECTION("a diagonal beside a robot that arrives") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{1, 1}}).robot({2, 0}, {{1, 0}});
    CHECK(optimal_cost(c) == Approx(2 + 1));  // likewise
  }
  SECTION("a diagonal beside a robot that stays") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 1}}).robot({1, 0}, {{1, 0}});
    CHECK(optimal_cost(c) == Approx(2));
    c.robots[1].state = DMRP_ROBOT_FAILED;
    CHECK(optimal_cost(c) == Approx(2));
  }
  SECTION("diagonals that swap") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{1, 1}}).robot({1, 1}, {{0, 0}});
    CHECK(optimal_cost(c) == Approx(4));  // around each other
  }
  SECTION("a goal that blocks another's only way: the robot there comes late or steps aside") {
    PlanningCase c({"....", "#.##", "#.##"});
    c.robot({3, 0}, {{1, 1}}).robot({0, 0}, {{1, 2}});
    optimal_cost(c);
  }
  SECTION("a robot at its goal gives way and comes back") {
    PlanningCase c({".....", "##.##"});
    c.robot({2, 0}, {{2, 0}}).robot({0, 0}, {{4, 0}});
    CHECK(optimal_cost(c) == Approx(4 + 3));
  }
  SECTION("four robots turn in a ring without a free cell beside") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{1, 1}}).robot({1, 1}, {{0, 1}}).robot({0, 1}, {{0, 0}});
    CHECK(optimal_cost(c) == Approx(4));
  }
  SECTION("in a corridor one robot follows another on its tour, to a goal that the other crosses before") {
    PlanningCase c({".....", "####."});
    c.robot({0, 0}, {{4, 0}, {0, 0}}).robot({4, 1}, {{2, 0}});
    CHECK(optimal_cost(c) == Approx(8 + 7));  // the second moves when the first turns back, one step behind it
  }
}

TEST_CASE("ECBS-8 proves that there is no plan") {
  SECTION("a goal that is cut off, in a wall, off the map") {
    PlanningCase cut_off({"..#.", "..#."});
    cut_off.robot({0, 0}, {{3, 0}});
    CHECK(run_planner(ecbs8, cut_off).status == DMRP_NO_SOLUTION);
    PlanningCase in_wall({"..#."});
    in_wall.robot({0, 0}, {{2, 0}});
    CHECK(run_planner(ecbs8, in_wall).status == DMRP_NO_SOLUTION);
    PlanningCase outside({"..#."});
    outside.robot({0, 0}, {{-3, 5}});
    CHECK(run_planner(ecbs8, outside).status == DMRP_NO_SOLUTION);
  }
  SECTION("cells that only share a corner do not connect") {
    PlanningCase c({".#", "#."});
    c.robot({0, 0}, {{1, 1}});
    CHECK(run_planner(ecbs8, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("a resting robot beside the only way, a diagonal") {
    PlanningCase c({"..", ".."});
    c.thin_wall({0, 0}, {0, 1}).robot({0, 0}, {{1, 1}}).robot({1, 0}, {}, DMRP_ROBOT_FINISHED);
    CHECK(run_planner(ecbs8, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("a swap in a corridor without a bay, however long") {
    PlanningCase c({std::string(200, '.')});
    c.robot({0, 0}, {{199, 0}}).robot({199, 0}, {{0, 0}});
    CHECK(run_planner(ecbs8, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("two robots that end on one cell") {
    PlanningCase c({"...", "..."});
    c.robot({0, 0}, {{1, 1}}).robot({2, 0}, {{1, 1}});
    CHECK(run_planner(ecbs8, c).status == DMRP_NO_SOLUTION);
  }
  SECTION("two of three robots in a ring would have to swap") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{0, 0}}).robot({1, 1}, {{1, 1}});
    CHECK(run_planner(ecbs8, c).status == DMRP_NO_SOLUTION);
  }
}

TEST_CASE("ECBS-8 gives up at its limit or when it is stopped") {
  SECTION("by its own limit") {
    const Plan plan = run_planner(ecbs8, jammed_case(), {{"node_limit", 50}});
    CHECK(plan.status == DMRP_TIMEOUT);
    CHECK(plan.statistics.at("high_level_generated") >= 50);
    CHECK(plan.statistics.at("high_level_generated") <= 52);
  }
  SECTION("by the host") {
    PluginUnderTest planner(library, ecbs8);
    check_stop_and_go(planner);
  }
}

TEST_CASE("ECBS-8: the same problem gives the same bits, whatever was planned before") {
  PluginUnderTest used(library, ecbs8);
  for (uint64_t seed = 2000; seed < 2040; ++seed) {
    const PlanningCase c = small_case(seed);
    PluginUnderTest fresh(library, ecbs8);
    REQUIRE(same_bits(run_planner(used, c, seed), run_planner(fresh, c, seed)));
  }
}

TEST_CASE("ECBS-8 solves 20 robots on three maps of 40x40 cells, and 50 on random-32-32-20") {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  const auto solve = [&](const std::string& map, int robots, int instances, double suboptimality) {
    PluginUnderTest planner(library, ecbs8, {{"suboptimality", suboptimality}});
    for (int i = 1; i <= instances; ++i) {
      CAPTURE(map, i, suboptimality);
      const PlanningCase c = read_instance(*data, map, robots, i);
      check_solved(c, run_planner(planner, c), suboptimality);
    }
  };
  for (const char* map : {"gen-random-40-40-10", "gen-random-40-40-20", "gen-rooms-40-40"}) solve(map, 20, 10, 2.0);
  for (const double suboptimality : {1.2, 2.0}) solve("random-32-32-20", 50, 5, suboptimality);
}

}  // namespace ecbs8_test
