// SPDX-License-Identifier: MIT
// CBS, ECBS and EECBS on instances of the MovingAI benchmark (Stern et al. 2019).
#include "tests/unit/planners/movingai.hpp"

#include <catch2/catch.hpp>

#include "tests/support/test_data.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/planner_variants.hpp"

namespace movingai_test {

using namespace dmrp::test;

// The folder with the data. Warns if there is none.
std::optional<std::filesystem::path> data_or_warn() {
  const auto data = test_data();
  if (!data) WARN("skipped: DMRP_TEST_DATA is not set");
  return data;
}

void check_solved(const std::string& id, double suboptimality, const std::string& map, int robots,
                  const std::vector<int>& instances) {
  const auto data = data_or_warn();
  if (!data) return;
  Variant variant(id, "", suboptimality, {});
  for (const int instance : instances) {
    CAPTURE(id, map, robots, instance);
    const PlanningCase c = read_instance(*data, map, robots, instance);
    const Plan plan = run_planner(*variant.planner, c);
    REQUIRE(plan.status == DMRP_OK);
    REQUIRE(check_plan(c, plan) == "");
    REQUIRE(plan.statistics.at("cost") == plan.cost());
    const double lower_bound = plan.statistics.at("lower_bound");
    REQUIRE(lower_bound <= plan.cost());
    REQUIRE(plan.cost() <= suboptimality * lower_bound + 1e-9);
  }
}

struct Crowd {
  int robots;
  int instances;
  int64_t node_limit;
};

// Whether the parameters change the number of expansions on some of the crowds.
bool changes_expansions(const std::filesystem::path& data, const std::string& id, const std::vector<Crowd>& crowds,
                        const ParamOverrides& changed) {
  for (const Crowd& crowd : crowds)
    for (int instance = 1; instance <= crowd.instances; ++instance) {
      const PlanningCase c = read_instance(data, "random-32-32-20", crowd.robots, instance);
      const auto expanded = [&](ParamOverrides overrides) {
        overrides["node_limit"] = crowd.node_limit;
        if (id == eecbs) overrides["suboptimality"] = 1.1;
        return run_planner(id, c, std::move(overrides)).statistics.at("high_level_expanded");
      };
      if (expanded({}) != expanded(changed)) return true;
    }
  return false;
}

TEST_CASE("CBS solves 20 robots on random-32-32-20") {
  check_solved(cbs, 1, "random-32-32-20", 20, {1, 2, 3, 4, 5});
}

TEST_CASE("CBS solves 40 robots on random-32-32-20") {
  check_solved(cbs, 1, "random-32-32-20", 40, {2, 3, 4, 5});
}

TEST_CASE("CBS solves 20 robots on 40x40 rooms") {
  check_solved(cbs, 1, "gen-rooms-40-40", 20, {1, 2, 3, 4, 5});
}

TEST_CASE("CBS solves 4 robots on 40x40 cells") {
  check_solved(cbs, 1, "gen-random-40-40-10", 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
}

TEST_CASE("CBS solves 100 robots on empty-32-32") {
  check_solved(cbs, 1, "empty-32-32", 100, {1, 2});
}

TEST_CASE("ECBS solves 100 robots on random-32-32-20") {
  check_solved(ecbs, 1.2, "random-32-32-20", 100, {1, 2, 3, 4, 5});
}

TEST_CASE("EECBS solves 100 robots on random-32-32-20") {
  check_solved(eecbs, 1.2, "random-32-32-20", 100, {1, 2, 3, 4, 5});
}

TEST_CASE("EECBS solves 80 robots on room-32-32-4") {
  check_solved(eecbs, 1.2, "room-32-32-4", 80, {1, 2});
}

TEST_CASE("every improvement of CBS changes what is expanded") {
  const auto data = data_or_warn();
  if (!data) return;
  std::vector<std::string> switches = improvements;
  switches.push_back("safe_intervals");
  for (const std::string& improvement : switches) {
    CAPTURE(improvement);
    CHECK(changes_expansions(*data, cbs, {{40, 5, 300}, {60, 2, 200}},
                             {{improvement, improvement == "disjoint_splitting"}}));
  }
}

TEST_CASE("every improvement of EECBS changes what is expanded") {
  const auto data = data_or_warn();
  if (!data) return;
  std::vector<std::string> switches = improvements;
  for (const char* own : {"explicit_estimation", "replan_in_place", "safe_intervals"}) switches.push_back(own);
  const std::vector<Crowd> crowds = {{100, 2, 300}, {120, 3, 500}};
  for (const std::string& improvement : switches) {
    CAPTURE(improvement);
    CHECK(changes_expansions(*data, eecbs, crowds, {{improvement, improvement == "disjoint_splitting"}}));
  }
  // the first restart has the published order, the second one weighs conflicts against steps
  CHECK_FALSE(changes_expansions(*data, eecbs, crowds, {{"conflict_steps", 0}}));
  CHECK(changes_expansions(*data, eecbs, {{150, 2, 3000}}, {{"conflict_steps", 0}}));
  CHECK(changes_expansions(*data, eecbs, crowds, {{"restart_after", 10}}));
}

}  // namespace movingai_test
