// SPDX-License-Identifier: MIT
// CBS, ECBS and EECBS with many combinations of parameters, and a check of the promises that all of them make.
#pragma once

#include <catch2/catch.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/planners/plan_check.hpp"

namespace dmrp::test {

inline constexpr const char* planner_library = "libdmrp_planners.so";
inline constexpr const char* individual = "dmrp.planner.individual";
inline constexpr const char* cbs = "dmrp.planner.cbs";
inline constexpr const char* ecbs = "dmrp.planner.ecbs";
inline constexpr const char* eecbs = "dmrp.planner.eecbs";

// The improvements that CBS and EECBS have in common; disjoint splitting is off by default.
inline const std::vector<std::string> improvements = {
    "prioritize_conflicts", "bypass",           "weighted_dependency_graph", "rectangle_reasoning",
    "corridor_reasoning",   "target_reasoning", "disjoint_splitting"};

// The number of answers of each kind.
struct Tally {
  int solved = 0;
  int unsolvable = 0;
  int given_up = 0;
};

struct Variant {
  std::string name;
  double suboptimality = 1;
  std::unique_ptr<PluginUnderTest> planner;
  Tally tally;

  Variant(const std::string& id, const std::string& what, double w, ParamOverrides overrides)
      : name(id + " " + what), suboptimality(w) {
    if (id != cbs) overrides["suboptimality"] = w;
    planner = std::make_unique<PluginUnderTest>(planner_library, id, std::move(overrides));
  }
};

// CBS with exactly these improvements.
inline Variant cbs_with(const std::vector<std::string>& on, ParamOverrides overrides) {
  std::string what;
  for (const std::string& improvement : improvements) overrides[improvement] = false;
  for (const std::string& improvement : on) {
    overrides[improvement] = true;
    what += "+" + improvement;
  }
  return Variant(cbs, what, 1, std::move(overrides));
}

// Checks all promises of an answer. A planner may give up on hard problems; its lower bound must hold there, too.
inline void check_answer(const PlanningCase& c, const Plan& plan, double suboptimality, std::optional<int> optimum,
                         Tally& tally) {
  if (!optimum) {
    REQUIRE(plan.status == DMRP_NO_SOLUTION);
    ++tally.unsolvable;
    return;
  }
  REQUIRE(plan.status != DMRP_NO_SOLUTION);
  const double lower_bound = plan.statistics.at("lower_bound");
  REQUIRE(lower_bound <= *optimum);
  if (plan.status == DMRP_TIMEOUT) {
    ++tally.given_up;
    return;
  }
  REQUIRE(plan.status == DMRP_OK);
  REQUIRE(check_plan(c, plan) == "");
  REQUIRE(plan.statistics.at("cost") == plan.cost());
  REQUIRE(plan.cost() <= suboptimality * lower_bound + 1e-9);
  if (suboptimality == 1) {
    REQUIRE(plan.cost() == *optimum);
    REQUIRE(lower_bound == *optimum);
  }
  ++tally.solved;
}

inline void plan_and_check(Variant& variant, const PlanningCase& c, std::optional<int> optimum, uint64_t seed = 1) {
  CAPTURE(variant.name, variant.suboptimality);
  check_answer(c, run_planner(*variant.planner, c, seed), variant.suboptimality, optimum, variant.tally);
}

}  // namespace dmrp::test
