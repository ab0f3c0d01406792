// SPDX-License-Identifier: MIT
// CBS, ECBS, EECBS and individual shortest paths through the C interface, against the optimum over joint positions.
#include <catch2/catch.hpp>

#include "tests/unit/planners/joint_optimum.hpp"
#include "tests/unit/planners/large_case.hpp"
#include "tests/unit/planners/planner_variants.hpp"
#include "tests/unit/planners/random_case.hpp"

namespace planners_test {

using namespace dmrp::test;

const std::vector<std::string> by_conflicts = {cbs, ecbs, eecbs};

// Small problems with their optimum, computed once for all test cases.
struct SolvedCase {
  PlanningCase problem;
  std::optional<int> optimum;
};
const std::vector<SolvedCase>& solved_cases() {
  static const std::vector<SolvedCase> cases = [] {
    std::vector<SolvedCase> out;
    for (uint64_t seed = 0; seed < 2400; ++seed) {
      const PlanningCase c = random_case(seed, seed % 4 == 3 ? 4 : 3);
      JointSearch search(c, 10'000);
      const std::optional<int> optimum = search.optimum();
      if (!search.gave_up()) out.push_back({c, optimum});
    }
    return out;
  }();
  return cases;
}

// Assigns each case to some of the variants: each variant gets many cases, and every case is used.
void share_out(std::vector<Variant>& variants, std::size_t variants_of_a_case) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < solved_cases().size(); ++i) {
    CAPTURE(i);
    const SolvedCase& c = solved_cases()[i];
    for (std::size_t k = 0; k < variants_of_a_case; ++k, next = (next + 1) % variants.size())
      plan_and_check(variants[next], c.problem, c.optimum);
  }
  for (const Variant& variant : variants) {
    CAPTURE(variant.name);
    CHECK(variant.tally.solved > 20);
    CHECK(variant.tally.unsolvable > 3);
    CHECK(variant.tally.given_up * 2 < variant.tally.solved);
  }
}

std::vector<std::string> all_but(const std::vector<std::string>& out) {
  std::vector<std::string> in;
  for (const std::string& improvement : improvements)
    if (improvement != "disjoint_splitting" && std::find(out.begin(), out.end(), improvement) == out.end())
      in.push_back(improvement);
  if (std::find(out.begin(), out.end(), "disjoint_splitting") != out.end()) in.push_back("disjoint_splitting");
  return in;
}

TEST_CASE("the library describes its planners") {
  const PluginLibrary& plugins = PluginLibrary::load(planner_library);
  for (const std::string& id : by_conflicts) {
    CAPTURE(id);
    const dmrp_descriptor* descriptor = plugins.find(id);
    REQUIRE(descriptor);
    CHECK(descriptor->kind == DMRP_KIND_GLOBAL_PLANNER);
    CHECK(dmrp::test::traits_of<dmrp_planner_traits>(*descriptor).connectivity == DMRP_CONNECTIVITY_4);
    CHECK(descriptor->flags == 0);
  }
  const dmrp_descriptor* descriptor = plugins.find(individual);
  REQUIRE(descriptor);
  CHECK(descriptor->kind == DMRP_KIND_GLOBAL_PLANNER);
  CHECK(dmrp::test::traits_of<dmrp_planner_traits>(*descriptor).connectivity == DMRP_CONNECTIVITY_4);
  CHECK(descriptor->flags == DMRP_FLAG_UNCOORDINATED);
}

TEST_CASE("random small problems: CBS finds the joint optimum, individual each robot's own") {
  Variant as_it_is(cbs, "as it is", 1, {{"node_limit", 2000}});
  PluginUnderTest individual_planner(planner_library, individual);
  int coordinated = 0;
  for (const SolvedCase& c : solved_cases()) {
    CAPTURE(&c - solved_cases().data());
    plan_and_check(as_it_is, c.problem, c.optimum);

    PlanningCase without_resting = c.problem;
    for (CaseRobot& robot : without_resting.robots) robot.state = DMRP_ROBOT_ACTIVE;
    const JointSearch alone(without_resting);
    const Plan own = run_planner(individual_planner, without_resting);
    bool cut_off = false;
    for (std::size_t i = 0; i < c.problem.robots.size(); ++i) cut_off = cut_off || !alone.alone(i);
    REQUIRE(own.status == (cut_off ? DMRP_NO_SOLUTION : DMRP_OK));
    if (cut_off) continue;
    REQUIRE(check_paths(without_resting, own) == "");
    for (std::size_t i = 0; i < c.problem.robots.size(); ++i)
      REQUIRE(static_cast<int>(own.paths[i].size()) - 1 == *alone.alone(i));
    if (c.optimum && *c.optimum > own.cost()) ++coordinated;
  }
  // The random cases must contain enough of each kind.
  CHECK(solved_cases().size() > 2350);
  CHECK(as_it_is.tally.solved > 1800);
  CHECK(as_it_is.tally.unsolvable > 300);
  CHECK(as_it_is.tally.given_up < 10);
  CHECK(coordinated > 100);
}

TEST_CASE("random small problems: CBS with any improvements finds the joint optimum") {
  std::vector<Variant> variants;
  for (const bool safe_intervals : {true, false}) {
    const ParamOverrides common = {{"node_limit", 300}, {"safe_intervals", safe_intervals}};
    variants.push_back(cbs_with({}, common));
    variants.push_back(cbs_with(all_but({}), common));
    for (std::size_t a = 0; a < improvements.size(); ++a)
      for (std::size_t b = 0; b <= a;
           ++b) {  // in pairs and, where a == b, alone; on with all others off, and the other way round
        std::vector<std::string> some = {improvements[a]};
        if (b != a) some.push_back(improvements[b]);
        variants.push_back(cbs_with(some, common));
        variants.push_back(cbs_with(all_but(some), common));
      }
  }
  share_out(variants, 8);
}

TEST_CASE("random small problems: ECBS stays within its bound") {
  std::vector<Variant> variants;
  for (const double suboptimality : {1.0, 1.05, 1.2, 1.5})
    for (const bool safe_intervals : {true, false})
      variants.emplace_back(ecbs, "", suboptimality,
                            ParamOverrides{{"node_limit", 300}, {"safe_intervals", safe_intervals}});
  share_out(variants, 2);
}

TEST_CASE("random small problems: EECBS with any improvements stays within its bound") {
  std::vector<Variant> variants;
  for (const double suboptimality : {1.0, 1.05, 1.2, 1.5}) {
    const auto add = [&](const std::string& key, const ParamOverride& value) {
      const auto* number = std::get_if<int64_t>(&value);
      variants.emplace_back(eecbs, key + (number ? "=" + std::to_string(*number) : ""), suboptimality,
                            ParamOverrides{{"node_limit", 300}, {key, value}});
    };
    for (const std::string& improvement : improvements) add(improvement, improvement == "disjoint_splitting");
    add("explicit_estimation", false);
    add("replan_in_place", false);
    add("safe_intervals", false);
    for (const int64_t steps : {0, 1, 3}) add("conflict_steps", steps);
    for (const int64_t nodes : {0, 1, 2, 3, 4, 5}) add("restart_after", nodes);
  }
  share_out(variants, 6);
}

TEST_CASE("crowded small problems: optimal with suboptimality 1") {
  for (const std::string& id : by_conflicts) {
    CAPTURE(id);
    Variant planner(id, "crowded", 1, {{"node_limit", 20000}});
    for (uint64_t seed = 0; seed < 60; ++seed) {
      CAPTURE(seed);
      Random random(seed + 77);
      PlanningCase c({"....", ".#..", "....", "...#"});
      std::vector<CellXY> starts;
      std::vector<CellXY> goals;
      for (std::vector<CellXY>* cells : {&starts, &goals})
        while (cells->size() < 4) {
          const CellXY cell{random.below(4), random.below(4)};
          if (c.is_free(cell) && std::find(cells->begin(), cells->end(), cell) == cells->end()) cells->push_back(cell);
        }
      for (std::size_t i = 0; i < 4; ++i) c.robot(starts[i], {goals[i]});
      plan_and_check(planner, c, JointSearch(c).optimum());
    }
    CHECK(planner.tally.given_up == 0);
  }
}

TEST_CASE("EECBS restarts in another order by another seed, and keeps its promises") {
  Variant restarting(eecbs, "restarts", 1.2, {{"node_limit", 300}, {"restart_after", 1}});
  int different = 0;
  for (std::size_t i = 0; i < solved_cases().size(); i += 12) {
    CAPTURE(i);
    const SolvedCase& c = solved_cases()[i];
    std::optional<Plan> first;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      CAPTURE(seed);
      const Plan plan = run_planner(*restarting.planner, c.problem, seed);
      check_answer(c.problem, plan, 1.2, c.optimum, restarting.tally);
      if (!first) first = plan;
      different += same_bits(*first, plan) ? 0 : 1;
    }
  }
  CHECK(different > 10);
}

TEST_CASE("EECBS restarts after so many expansions, however many paths it replans in place") {
  int solved = 0;
  for (uint64_t seed = 0; seed < 12; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = large_case(seed, 50);
    const Plan plan = run_planner(eecbs, c, {{"suboptimality", 1.02}, {"node_limit", 400}, {"restart_after", 0}});
    if (plan.status != DMRP_OK) continue;
    ++solved;
    // the first search gets a quarter, and that is enough
    const auto expanded = static_cast<int64_t>(plan.statistics.at("high_level_expanded"));
    const ParamOverrides restarting = {{"suboptimality", 1.02}, {"node_limit", 400}, {"restart_after", 4 * expanded}};
    CHECK(same_bits(plan, run_planner(eecbs, c, restarting)));
  }
  CHECK(solved > 3);
}

TEST_CASE("the same problem and seed give the same bits, whatever was planned before") {
  const std::vector<std::pair<std::string, ParamOverrides>> planners = {
      {cbs, {{"node_limit", 300}}},
      {ecbs, {{"node_limit", 300}}},
      {eecbs, {{"node_limit", 300}}},
      {eecbs, {{"node_limit", 300}, {"restart_after", 1}}}};
  std::vector<std::unique_ptr<PluginUnderTest>> used;
  for (const auto& [id, overrides] : planners)
    used.push_back(std::make_unique<PluginUnderTest>(planner_library, id, overrides));
  for (uint64_t seed = 5000; seed < 5060; ++seed) {
    CAPTURE(seed);
    const PlanningCase c = random_case(seed, 4);
    std::vector<Plan> plans;
    for (const auto& planner : used) plans.push_back(run_planner(*planner, c, seed));
    for (std::size_t i = planners.size(); i-- > 0;) {
      PluginUnderTest fresh(planner_library, planners[i].first, planners[i].second);
      REQUIRE(same_bits(plans[i], run_planner(fresh, c, seed)));
    }
  }
}

}  // namespace planners_test
