// SPDX-License-Identifier: MIT
// Large neighborhood search, against joint search on small problems, and by the plan check alone on large ones.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/test_data.hpp"
#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/movingai.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/random_case.hpp"
#include "tests/unit/planners/stopping.hpp"

namespace lns_test {

using namespace dmrp::test;

const char* const library = "libdmrp_planners.so";
const char* const lns = "dmrp.planner.lns";

TEST_CASE("large neighborhood search solves every solvable small problem within 5 % of the joint optimum") {
  PluginUnderTest planner(library, lns, {{"iterations", 2000}});
  int sum = 0;
  int least_sum = 0;
  int optimal = 0;
  int solved = 0;
  for (uint64_t seed = 70'000; seed < 70'120; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = random_case(seed, 4);
    const std::optional<int> optimum = JointSearch(c).optimum();
    const Plan plan = run_planner(planner, c);
    REQUIRE(plan.status == (optimum ? DMRP_OK : DMRP_NO_SOLUTION));
    if (!optimum) continue;
    ++solved;
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.cost() >= *optimum);
    REQUIRE(plan.statistics.at("cost") == plan.cost());
    REQUIRE(plan.statistics.at("lower_bound") <= *optimum);
    sum += plan.cost();
    least_sum += *optimum;
    optimal += plan.cost() == *optimum;
  }
  CHECK(solved > 80);
  CHECK(sum <= 1.05 * least_sum);
  CHECK(optimal > solved * 9 / 10);
}

TEST_CASE("large neighborhood search has a plan without conflicts after every iteration, and it never gets dearer") {
  int plans = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    const PlanningCase c = large_case(seed, 20 + static_cast<int>(seed % 6) * 40);
    double before = 1e9;
    for (const std::int64_t iterations : {1, 30, 300}) {
      CAPTURE(seed, iterations);
      const Plan plan = run_planner(lns, c, {{"iterations", iterations}});
      if (plan.status == DMRP_NO_SOLUTION) break;  // a goal that is cut off
      REQUIRE(plan.status == DMRP_OK);
      REQUIRE(check_plan(c, plan) == "");
      REQUIRE(plan.statistics.at("cost") == plan.cost());
      REQUIRE(plan.cost() <= plan.statistics.at("first_cost"));
      REQUIRE(plan.statistics.at("iterations") <= static_cast<double>(iterations));
      REQUIRE(plan.cost() <= before);
      before = plan.cost();
    }
    plans += before < 1e9;
  }
  CHECK(plans > 5);
}

TEST_CASE("large neighborhood search plans tours") {
  PlanningCase c({".....", "####."});
  c.robot({0, 0}, {{4, 0}, {0, 0}}).robot({4, 1}, {{2, 0}});
  const Plan plan = run_planner(lns, c);
  REQUIRE(plan.status == DMRP_OK);
  CHECK(check_plan(c, plan) == "");
  CHECK(plan.cost() == 8 + 7);
  PlanningCase equal({"...", "#.#"});
  equal.robot({1, 1}, {{1, 0}, {1, 0}, {1, 0}}).robot({0, 0}, {{2, 0}});
  const Plan waits = run_planner(lns, equal);
  REQUIRE(waits.status == DMRP_OK);
  CHECK(check_plan(equal, waits) == "");
  CHECK(waits.cost() == *JointSearch(equal).optimum());
}

TEST_CASE("large neighborhood search gives the same bits for the same seed, and others for other seeds") {
  PluginUnderTest used(library, lns, {{"iterations", 100}});
  int differ = 0;
  for (uint64_t seed = 300; seed < 315; ++seed) {
    const PlanningCase c = large_case(seed, 80);
    PluginUnderTest fresh(library, lns, {{"iterations", 100}});
    const Plan plan = run_planner(used, c, seed);
    REQUIRE(same_bits(plan, run_planner(fresh, c, seed)));
    if (plan.status == DMRP_OK && !same_bits(plan, run_planner(fresh, c, seed + 1))) ++differ;
  }
  CHECK(differ > 3);
}

TEST_CASE("large neighborhood search that is stopped returns the plan that it has") {
  PluginUnderTest planner(library, lns, {{"iterations", 0}});
  check_stop_and_go(planner);
  PlanningCase crowd = large_case(7, 80);
  int with_plan = 0;
  int without = 0;
  double before = 1e9;
  for (int calls_until_stop = 0; calls_until_stop < 2000; calls_until_stop += 1 + calls_until_stop / 5) {
    CAPTURE(calls_until_stop);
    int calls = 0;
    planner.host().should_stop = [&] { return ++calls > calls_until_stop; };
    const Plan plan = run_planner(planner, crowd);
    REQUIRE((plan.status == DMRP_OK || plan.status == DMRP_TIMEOUT));
    if (plan.status == DMRP_OK) {
      REQUIRE(check_plan(crowd, plan) == "");
      REQUIRE(plan.cost() <= before);
      before = plan.cost();
    }
    with_plan += plan.status == DMRP_OK;
    without += plan.status == DMRP_TIMEOUT;
  }
  CHECK(with_plan > 5);
  CHECK(without > 5);
}

TEST_CASE("large neighborhood search improves crowded maps") {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  PluginUnderTest planner(library, lns, {{"iterations", 300}});
  const struct {
    const char* map;
    int robots;
  } crowds[] = {{"random-32-32-20", 200}, {"room-32-32-4", 150}, {"maze-32-32-4", 100}};
  for (const auto& crowd : crowds) {
    CAPTURE(crowd.map);
    const PlanningCase c = read_instance(*data, crowd.map, crowd.robots, 1);
    const Plan plan = run_planner(planner, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    CHECK(plan.cost() < 0.95 * plan.statistics.at("first_cost"));
  }
}

// Small sets alone end at 5,372 and more: robots rest in passages that others then go round.
TEST_CASE("large neighborhood search gets robots out of the way that rest where others have to pass") {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  PluginUnderTest planner(library, lns, {{"iterations", 6000}});
  const PlanningCase c = read_instance(*data, "maze-32-32-4", 100, 2);
  int least = std::numeric_limits<int>::max();
  for (const std::uint64_t seed : {1, 2}) {
    const Plan plan = run_planner(planner, c, seed);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    least = std::min(least, plan.cost());
  }
  CHECK(least < 5000);
}

TEST_CASE("large neighborhood search begins with a prioritized plan as long as that gets on") {
  const auto data = test_data();
  if (!data) {
    WARN("skipped: DMRP_TEST_DATA is not set");
    return;
  }
  const PlanningCase c = read_instance(*data, "room-32-32-4", 250, 1);
  const Plan prioritized = run_planner("dmrp.planner.sipp", c, {{"restarts", 0}});
  REQUIRE(prioritized.status == DMRP_OK);
  const Plan plan = run_planner(lns, c, {{"iterations", 1}});
  REQUIRE(plan.status == DMRP_OK);
  CHECK(plan.statistics.at("first_cost") <= prioritized.cost());
}

}  // namespace lns_test
