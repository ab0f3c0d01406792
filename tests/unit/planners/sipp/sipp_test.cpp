// SPDX-License-Identifier: MIT
// Prioritized SIPP, against joint search on small problems, and by the plan check alone on large ones.
#include <algorithm>
#include <catch2/catch.hpp>

#include "planners/mapf/safe_intervals.hpp"
#include "tests/support/test_data.hpp"
#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/movingai.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/random_case.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace sipp_test {

using namespace dmrp::test;
using dmrp::planners::Location;
using dmrp::planners::SafeIntervals;

const char* const library = "libdmrp_planners.so";
const char* const sipp = "dmrp.planner.sipp";

// Steps from one cell to another among resting robots only; nothing if it is cut off.
std::optional<int> steps_between(const PlanningCase& c, CellXY from, CellXY to) {
  std::vector<int> steps(c.free.size(), -1);
  for (const CaseRobot& robot : c.robots)
    if (robot.state != DMRP_ROBOT_ACTIVE) steps[c.index(robot.start)] = 0;
  if (steps[c.index(to)] == 0) return std::nullopt;
  std::vector<CellXY> queue = {from};
  steps[c.index(from)] = 0;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const CellXY at = queue[i];
    if (at == to) return steps[c.index(at)];
    for (const CellXY next : {CellXY{at.x + 1, at.y}, {at.x - 1, at.y}, {at.x, at.y + 1}, {at.x, at.y - 1}}) {
      if (!c.is_free(next) || !c.is_open(at, next) || steps[c.index(next)] >= 0) continue;
      steps[c.index(next)] = steps[c.index(at)] + 1;
      queue.push_back(next);
    }
  }
  return std::nullopt;
}

// The sum of the robots' costs, each among resting robots only; nothing if one is cut off.
std::optional<int> sum_alone(const PlanningCase& c) {
  int sum = 0;
  for (const CaseRobot& robot : c.robots) {
    if (robot.state != DMRP_ROBOT_ACTIVE) continue;
    CellXY at = robot.start;
    for (std::size_t leg = 0; leg < robot.goals.size(); ++leg) {
      const auto steps = steps_between(c, at, robot.goals[leg]);
      if (!steps) return std::nullopt;
      sum += leg > 0 ? std::max(*steps, 1) : *steps;  // a wait between equal goals
      at = robot.goals[leg];
    }
  }
  return sum;
}

TEST_CASE("SIPP describes itself") {
  const dmrp_descriptor* descriptor = PluginLibrary::load(library).find(sipp);
  REQUIRE(descriptor);
  CHECK(descriptor->kind == DMRP_KIND_GLOBAL_PLANNER);
  CHECK(dmrp::test::traits_of<dmrp_planner_traits>(*descriptor).connectivity == DMRP_CONNECTIVITY_4);
  CHECK(descriptor->flags == 0);
}

TEST_CASE("SIPP solves nearly all random small problems, and its proofs are right") {
  PluginUnderTest planner(library, sipp, {{"restarts", 100}});
  const struct {
    int most_robots;
    uint64_t from;
    uint64_t count;
  } draws[] = {{3, 0, 3000}, {4, 50'000, 150}};
  int solvable = 0;
  int solved = 0;
  int unsolvable = 0;
  int dearer = 0;
  for (const auto& draw : draws)
    for (uint64_t seed = draw.from; seed < draw.from + draw.count; ++seed) {
      CAPTURE(seed);
      const PlanningCase c = random_case(seed, draw.most_robots);
      const std::optional<int> optimum = JointSearch(c).optimum();
      const Plan plan = run_planner(planner, c);
      if (!optimum) {
        ++unsolvable;
        REQUIRE(plan.status == DMRP_NO_SOLUTION);
        continue;
      }
      ++solvable;
      REQUIRE(plan.statistics.at("lower_bound") == sum_alone(c));
      if (plan.status != DMRP_OK) {
        REQUIRE(plan.status == DMRP_TIMEOUT);
        REQUIRE(plan.statistics.at("restarts") == 100);
        continue;
      }
      ++solved;
      REQUIRE(check_plan(c, plan) == "");
      REQUIRE(plan.cost() >= *optimum);
      REQUIRE(plan.statistics.at("cost") == plan.cost());
      dearer += plan.cost() > *optimum;
    }
  // No order solves problems in which two robots have to give way to each other. Few problems are of that kind.
  CHECK(solvable > 2500);
  CHECK(solved >= solvable - solvable / 400);
  CHECK(unsolvable > 100);
  CHECK(dearer > 100);
}

TEST_CASE("SIPP plans have no conflicts on large and crowded grids") {
  PluginUnderTest planner(library, sipp);
  int solved = 0;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = large_case(seed, 20 + static_cast<int>(seed % 5) * 25);
    const Plan plan = run_planner(planner, c, seed);
    if (!sum_alone(c)) {
      REQUIRE(plan.status == DMRP_NO_SOLUTION);
      continue;
    }
    ++solved;
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.statistics.at("lower_bound") == sum_alone(c));
  }
  CHECK(solved > 20);
}

TEST_CASE("SIPP avoids the robots planned before") {
  const auto solve = [](const PlanningCase& c, int cost) {
    const Plan plan = run_planner(sipp, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() == cost);
  };
  SECTION("a parked robot on the shortest way: around it") {
    PlanningCase c({".....", "....."});
    solve(c.robot({2, 0}, {{2, 0}}).robot({0, 0}, {{4, 0}}), 6);
  }
  SECTION("a robot that parks in the only way: it comes late") {
    PlanningCase c({".....", "##.##"});
    solve(c.robot({2, 1}, {{2, 0}}).robot({0, 0}, {{4, 0}}), 3 + 4);
  }
  SECTION("a robot that is parked in the only way: it gives way") {
    PlanningCase c({".....", "##.##"});
    solve(c.robot({2, 0}, {{2, 0}}).robot({0, 0}, {{4, 0}}), 4 + 3);
  }
  SECTION("a waiting robot: no collision") {
    // The first robot waits for the crossing one; the second has to wait behind it.
    PlanningCase c({"#.##", "....", "#.##", "#.##", "#.##"});
    solve(c.robot({1, 0}, {{1, 3}}).robot({0, 1}, {{3, 1}}).robot({1, 1}, {{1, 4}}), 3 + 4 + 3);
  }
  SECTION("a robot that comes the other way: no swap") {
    PlanningCase c({"...."});
    c.robot({1, 0}, {{2, 0}}).robot({2, 0}, {{1, 0}});
    CHECK(run_planner(sipp, c).status == DMRP_NO_SOLUTION);
    PlanningCase with_bay({"....", "#..#"});
    solve(with_bay.robot({1, 0}, {{2, 0}}).robot({2, 0}, {{1, 0}}), 1 + 3);
  }
  SECTION("a corridor with one bay in the middle: whoever comes first, it has to be late") {
    PlanningCase c({".......", "###.###"});
    c.robot({0, 0}, {{6, 0}}).robot({6, 0}, {{0, 0}});
    solve(c, 6 + 6 + 3);
    CHECK(run_planner(sipp, c).statistics.at("restarts") > 0);
    CHECK(run_planner(sipp, c, {{"restarts", 0}}).status == DMRP_TIMEOUT);
  }
  SECTION("a goal that blocks another's only way") {
    PlanningCase c({"....", "#.##", "#.##"});
    c.robot({3, 0}, {{1, 1}}).robot({0, 0}, {{1, 2}});
    solve(c, *JointSearch(c).optimum());
  }
  SECTION("four in a ring without a free cell") {
    PlanningCase c({"..", ".."});
    solve(c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{1, 1}}).robot({1, 1}, {{0, 1}}).robot({0, 1}, {{0, 0}}), 4);
  }
  SECTION("robots that rest") {
    PlanningCase c({"...", "...", "..."});
    solve(c.robot({0, 1}, {{2, 1}}).robot({1, 1}, {}, DMRP_ROBOT_FINISHED), 4);
  }
  SECTION("a start that others cross before its robot is planned") {
    // The robot at the dead end has the farthest goal, so it comes last; all others pass through its start.
    PlanningCase c({"........", ".#######", ".......#"});
    solve(c.robot({1, 0}, {{3, 2}}).robot({2, 0}, {{2, 2}}).robot({0, 0}, {{6, 2}}), 6 + 6 + 8);
  }
}

TEST_CASE("SIPP plans tours") {
  SECTION("start is goal") {
    PlanningCase c({"..."});
    const Plan plan = run_planner(sipp, c.robot({1, 0}, {{1, 0}}));
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
    CHECK(plan.cost() == 0);
  }
  SECTION("equal goals in a row cost a wait each") {
    PlanningCase c({"..."});
    const Plan plan = run_planner(sipp, c.robot({0, 0}, {{2, 0}, {2, 0}, {2, 0}, {1, 0}}));
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
    CHECK(plan.cost() == 2 + 2 + 1);
  }
  SECTION("equal goals at the end, where another passes between") {
    PlanningCase c({"...", "#.#"});
    c.robot({1, 1}, {{1, 0}, {1, 0}, {1, 0}}).robot({0, 0}, {{2, 0}});
    const Plan plan = run_planner(sipp, c);
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
    CHECK(plan.cost() == JointSearch(c).optimum());
  }
  SECTION("over the other's goal before it parks there") {
    PlanningCase c({".....", "####."});
    c.robot({0, 0}, {{4, 0}, {0, 0}}).robot({4, 1}, {{2, 0}});
    const Plan plan = run_planner(sipp, c);
    REQUIRE(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
    CHECK(plan.cost() == 8 + 7);
  }
  SECTION("no active robot") {
    PlanningCase c({"..."});
    CHECK(run_planner(sipp, c).status == DMRP_OK);
    const Plan plan = run_planner(sipp, c.robot({1, 0}, {}, DMRP_ROBOT_FINISHED));
    CHECK(plan.status == DMRP_OK);
    CHECK(check_plan(c, plan) == "");
  }
}

TEST_CASE("SIPP takes a path with fewest turns where it is free") {
  for (int x = 0; x < 9; x += 2)
    for (int y = 0; y < 7; y += 3) {
      CAPTURE(x, y);
      PlanningCase c(std::vector<std::string>(7, "........."));
      const Plan plan = run_planner(sipp, c.robot({4, 3}, {{x, y}}));
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      CHECK(turns_of(plan.paths[0]) == (x != 4 && y != 3 ? 1 : 0));
    }
}

TEST_CASE("SIPP without a plan: a proof or an end") {
  SECTION("a goal that is cut off, by walls or by a robot that rests") {
    PlanningCase c({"..#.", "..#."});
    CHECK(run_planner(sipp, c.robot({0, 0}, {{3, 0}})).status == DMRP_NO_SOLUTION);
    PlanningCase resting({"....."});
    resting.robot({0, 0}, {{4, 0}}).robot({2, 0}, {}, DMRP_ROBOT_FAILED);
    CHECK(run_planner(sipp, resting).status == DMRP_NO_SOLUTION);
  }
  SECTION("two of three in a ring would have to swap: all joint positions are tried") {
    PlanningCase c({"..", ".."});
    c.robot({0, 0}, {{1, 0}}).robot({1, 0}, {{0, 0}}).robot({1, 1}, {{1, 1}});
    const Plan plan = run_planner(sipp, c);
    CHECK(plan.status == DMRP_NO_SOLUTION);
    CHECK(plan.statistics.at("restarts") == 0);
  }
  SECTION("by its own limit") {
    const Plan plan = run_planner(sipp, jammed_case(), {{"restarts", 3}});
    CHECK(plan.status == DMRP_TIMEOUT);
    CHECK(plan.statistics.at("restarts") == 3);
    CHECK(plan.statistics.at("lower_bound") == 8 * 119 - 2 * (0 + 2 + 4 + 6));
  }
  SECTION("by the host") {
    PluginUnderTest planner(library, sipp, {{"restarts", 100'000'000}});
    check_stop_and_go(planner);
  }
}

TEST_CASE("SIPP gives the same bits for the same seed, whatever was planned before, and others for other seeds") {
  PluginUnderTest used(library, sipp);
  int differ = 0;
  for (uint64_t seed = 300; seed < 330; ++seed) {
    const PlanningCase c = large_case(seed, 60);
    PluginUnderTest fresh(library, sipp);
    const Plan plan = run_planner(used, c, seed);
    REQUIRE(same_bits(plan, run_planner(fresh, c, seed)));
    if (plan.status == DMRP_OK && !same_bits(plan, run_planner(fresh, c, seed + 1))) ++differ;
  }
  CHECK(differ > 3);
}

TEST_CASE("occupations follow the paths added and removed") {
  Random random(5);
  const PlanningCase grid(std::vector<std::string>(3, "..."));
  const CProblem host(grid);
  const auto problem = dmrp::planners::make_problem(dmrp::PlanningProblem(host.problem()), true);
  SafeIntervals table(problem.graph);
  std::vector<std::vector<Location>> paths(4);  // empty: not in the table
  const auto where = [&](std::size_t agent, int t) {
    const auto& path = paths[agent];
    return path.empty() ? dmrp::planners::nowhere : path[std::min(static_cast<std::size_t>(t), path.size() - 1)];
  };
  for (int round = 0; round < 3000; ++round) {
    const auto agent = static_cast<std::size_t>(random.below(4));
    table.remove(paths[agent]);
    paths[agent].clear();
    std::vector<Location> walk = {random.below(9)};
    for (int steps = random.below(12); steps > 0; --steps) {
      const Location to = problem.graph.neighbor(walk.back(), random.below(4));
      walk.push_back(to == dmrp::planners::nowhere ? walk.back() : to);
    }
    std::vector<int32_t> expected;
    for (int t = 0; t < 14; ++t)
      for (int other = 0; other < 4; ++other) {
        const Location now = walk[std::min(static_cast<std::size_t>(t), walk.size() - 1)];
        const Location before = walk[std::min(static_cast<std::size_t>(std::max(t - 1, 0)), walk.size() - 1)];
        const auto o = static_cast<std::size_t>(other);
        const bool swap = now != before && where(o, t) == before && where(o, t - 1) == now;
        if ((where(o, t) == now || swap) && std::find(expected.begin(), expected.end(), other) == expected.end())
          expected.push_back(other);
      }
    std::vector<int32_t> met;
    table.list_conflicts(walk, met);
    std::sort(met.begin(), met.end());
    std::sort(expected.begin(), expected.end());
    REQUIRE(met == expected);
    if (!met.empty()) continue;
    paths[agent] = walk;
    table.add(static_cast<int32_t>(agent), paths[agent]);
    for (Location location = 0; location < 9; ++location) {
      int32_t free_from = 0;
      for (const auto& occupation : table.occupations(location)) {
        REQUIRE(occupation.from >= free_from);
        for (int t = occupation.from; t <= std::min(occupation.to, 14); ++t)
          REQUIRE(where(static_cast<std::size_t>(occupation.agent), t) == location);
        free_from = occupation.to + 1;
      }
    }
  }
}

void check_movingai(const std::string& map, int robots) {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  PluginUnderTest planner(library, sipp);
  for (int i = 1; i <= 5; ++i) {
    const PlanningCase c = read_instance(*data, map, robots, i);
    CAPTURE(map, i);
    const Plan plan = run_planner(planner, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.statistics.at("cost") == plan.cost());
    REQUIRE(plan.statistics.at("restarts") == 0);
  }
}

TEST_CASE("SIPP solves 200 robots on random-32-32-20") {
  check_movingai("random-32-32-20", 200);
}

TEST_CASE("SIPP solves 400 robots on empty-32-32") {
  check_movingai("empty-32-32", 400);
}

TEST_CASE("SIPP solves 80 robots in a maze and in rooms") {
  check_movingai("maze-32-32-2", 80);
  check_movingai("room-32-32-4", 80);
}

}  // namespace sipp_test
