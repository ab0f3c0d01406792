// SPDX-License-Identifier: MIT
// The promises of CBS, ECBS and EECBS hold with all parameters, and all planners keep theirs wherever they are stopped.
#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/plan_check.hpp"
#include "tests/unit/planners/random_case.hpp"

namespace promises_test {

using namespace dmrp::test;

struct Variant {
  std::string id;
  ParamOverrides parameters;
  double suboptimality;
};

std::vector<Variant> variants() {
  const std::string cbs = "dmrp.planner.cbs";
  const std::string ecbs = "dmrp.planner.ecbs";
  const std::string eecbs = "dmrp.planner.eecbs";
  std::vector<Variant> all = {
      {cbs, {}, 1},
      {cbs, {{"disjoint_splitting", true}}, 1},
      {cbs, {{"safe_intervals", false}}, 1},
      {cbs, {{"safe_intervals", false}, {"disjoint_splitting", true}}, 1},
      {ecbs, {}, 1.2},
      {ecbs, {{"safe_intervals", false}}, 1.2},
      {eecbs, {}, 1.2},
      {eecbs, {{"restart_after", 5}, {"disjoint_splitting", true}}, 1.05},
      {eecbs, {{"restart_after", 5}, {"conflict_steps", 0}, {"explicit_estimation", false}}, 1.1},
  };
  for (Variant& variant : all) {
    variant.parameters["node_limit"] = 1000;
    if (variant.id != cbs) variant.parameters["suboptimality"] = variant.suboptimality;
  }
  return all;
}

// Some moves exist in one direction only.
PlanningCase one_way_case(uint64_t seed, int most_robots) {
  PlanningCase c = random_case(seed, most_robots);
  Random random(seed * 7 + 3);
  for (int y = 0; y < c.height; ++y)
    for (int x = 0; x < c.width; ++x)
      for (const CellXY step : {CellXY{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        if (const CellXY to{x + step.x, y + step.y}; random.below(100) < 6 && c.is_free({x, y}) && c.is_free(to))
          c.close_one_way({x, y}, to);
  return c;
}

// The error of an answer; empty if there is none.
std::string check_answer(const PlanningCase& c, const Plan& plan, std::optional<int> optimum, double suboptimality) {
  if (plan.status == DMRP_NO_SOLUTION) return optimum ? "no solution, though there is one" : "";
  const auto bound = plan.statistics.find("lower_bound");
  if (optimum && bound != plan.statistics.end() && bound->second > *optimum) return "a bound above the optimum";
  if (plan.status == DMRP_TIMEOUT) return "";
  if (plan.status != DMRP_OK) return "status " + std::to_string(plan.status);
  if (bound == plan.statistics.end()) return "no bound";
  if (plan.cost() > suboptimality * bound->second + 1e-6) return "a cost beyond what the bound allows";
  return check_plan(c, plan);
}

TEST_CASE("four robots and one-way moves: bounds and costs hold with every choice of parameters") {
  for (const Variant& variant : variants()) {
    PluginUnderTest planner("libdmrp_planners.so", variant.id, variant.parameters);
    for (uint64_t seed = 20050; seed < 20080; ++seed) {
      const PlanningCase c = one_way_case(seed, 4);
      CAPTURE(variant.id, variant.parameters.size(), variant.suboptimality, seed);
      REQUIRE(check_answer(c, run_planner(planner, c), JointSearch(c).optimum(), variant.suboptimality) == "");
    }
  }
}

TEST_CASE("a planner that is stopped knows at least the sum of the robots' costs alone") {
  PlanningCase c(std::vector<std::string>(6, "......"));
  for (int y = 0; y < 6; ++y) c.robot({y % 2 == 0 ? 0 : 5, y}, {{y % 2 == 0 ? 5 : 0, y}});
  c.robot({3, 0}, {{3, 5}});
  for (const char* id : {"cbs", "ecbs", "eecbs", "ecbs8", "sipp", "lacam", "lns"}) {
    PluginUnderTest planner("libdmrp_planners.so", std::string("dmrp.planner.") + id);
    int known = 0;
    for (int calls_until_stop = 0; calls_until_stop < 30; ++calls_until_stop) {
      CAPTURE(id, calls_until_stop);
      int calls = 0;
      planner.host().should_stop = [&] { return ++calls > calls_until_stop; };
      const Plan plan = run_planner(planner, c);
      const auto bound = plan.statistics.find("lower_bound");
      if (bound == plan.statistics.end()) continue;  // stopped before the distances were known
      ++known;
      REQUIRE(bound->second >= 6 * 5 + 5);
    }
    CHECK(known > 10);
  }
}

TEST_CASE("a planner asks whether to stop at least every 256 states, and at each step of all robots") {
  const PlanningCase c = large_case(7, 80);
  for (const char* id : {"cbs", "ecbs", "eecbs", "ecbs8", "sipp", "lacam", "lns", "pibt"}) {
    CAPTURE(id);
    PluginUnderTest planner("libdmrp_planners.so", std::string("dmrp.planner.") + id);
    for (const int calls_until_stop : {500, 2000, 4000}) {
      CAPTURE(calls_until_stop);
      int calls = 0;
      planner.host().should_stop = [&] { return ++calls > calls_until_stop; };
      const Plan plan = run_planner(planner, c);
      REQUIRE(calls <= calls_until_stop + 1);
      const auto count = [&](const char* name) {
        const auto found = plan.statistics.find(name);
        return found == plan.statistics.end() ? 0 : found->second;
      };
      CHECK(count("low_level_expanded") <= 256.0 * calls);
      CHECK(count("high_level_expanded") <= calls);
      std::size_t steps = 0;
      for (const auto& path : plan.paths) steps = std::max(steps, path.size());
      if (std::string(id) == "pibt") CHECK(steps <= static_cast<std::size_t>(calls) + 1);
    }
  }
}

TEST_CASE("a planner that is stopped anywhere times out or returns a valid plan") {
  int given_up = 0;
  for (const Variant& variant : variants()) {
    PluginUnderTest planner("libdmrp_planners.so", variant.id, variant.parameters);
    for (uint64_t seed = 300; seed < 306; ++seed) {
      const PlanningCase c = random_case(seed, 4);
      const std::optional<int> optimum = JointSearch(c).optimum();
      for (int calls_until_stop = 0; calls_until_stop < 40; ++calls_until_stop) {
        CAPTURE(variant.id, variant.parameters.size(), variant.suboptimality, seed, calls_until_stop);
        int calls = 0;
        planner.host().should_stop = [&] { return ++calls > calls_until_stop; };
        const Plan plan = run_planner(planner, c);
        REQUIRE(check_answer(c, plan, optimum, variant.suboptimality) == "");
        given_up += plan.status == DMRP_TIMEOUT;
      }
    }
  }
  CHECK(given_up > 100);
}

}  // namespace promises_test
