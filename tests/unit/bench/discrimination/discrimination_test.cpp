// SPDX-License-Identifier: MIT
// Whether tasks tell entries apart, of trials whose answer is known.
#include "tests/bench/discrimination/discrimination.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace discrimination_test {

using namespace dmrp::bench;
using namespace dmrp::host;
using namespace dmrp::test;

// Two robots on a task of the repetition's own; each arrives with this probability, harder tasks have longer ways.
MakeRobots arriving(double probability, std::uint64_t seed) {
  return [=](std::uint32_t i) {
    dmrp::toolkit::Stream stream(seed, "test.arrivals", i);
    const double way_m = 10.0 + i;
    std::vector<RobotResult> robots;
    for (int robot = 0; robot < 2; ++robot) {
      const bool arrives = stream.chance(probability);
      robots.push_back({arrives ? std::optional(2.0 * way_m) : std::nullopt, true, way_m});
    }
    return robots;
  };
}

Discrimination only(const std::vector<TrialRecord>& trials) {
  const auto found = discriminations(ranking_layout(), ranking_metrics(), trials);
  REQUIRE(found.size() == 1);
  return found.front();
}

TEST_CASE("entries that differ much are told apart, and the tasks pass", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "weak", 40, arriving(0.2, 1));
  add_trials(trials, "middling", 40, arriving(0.55, 2));
  add_trials(trials, "strong", 40, arriving(0.95, 3));
  const Discrimination result = only(trials);
  CHECK(result.tasks == 40);
  CHECK(result.pairs == 3);
  CHECK(result.separated == 3);
  CHECK(result.at_ceiling == 0);
  CHECK(result.share_effect.partial_eta_squared > 0.3);
  CHECK(result.half_agreement > 0.9);
  REQUIRE(result.tasks_needed);
  CHECK(*result.tasks_needed > 100);  // a deviation of about a half, and a difference of 0.05
  CHECK(misses(result, false).empty());

  const auto found = contrast(result, result.entries[0].name, result.entries[2].name);
  REQUIRE(found);
  CHECK(found->difference == Approx(result.entries[2].share - result.entries[0].share));
  CHECK(found->interval.low > 0.5);
  CHECK(found->interval.high < 0.95);
  CHECK(found->p < 0.001);
  CHECK(contrast(result, result.entries[0].name, result.entries[0].name)->p == 1.0);
  CHECK_FALSE(contrast(result, result.entries[0].name, "nobody"));
}

TEST_CASE("one entry under two labels is not told apart from itself", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "one", 40, arriving(0.6, 1));
  add_trials(trials, "the same", 40, arriving(0.6, 1));
  const Discrimination result = only(trials);
  CHECK(result.separated_share() == 0.0);
  CHECK(std::isnan(result.share_effect.partial_eta_squared));  // nothing varies within tasks
  CHECK(misses(result, false).size() == 3);                    // D, the effect, the halves (all ties)
}

TEST_CASE("a difference below the least of interest does not count, however certain", "[ranking]") {
  const auto with_pace = [](double s_per_m) {
    return [=](std::uint32_t i) {
      const double way_m = 10.0 + i;
      return std::vector<RobotResult>{{(s_per_m + 0.001 * (i % 3)) * way_m, true, way_m}};
    };
  };
  std::vector<TrialRecord> trials;
  add_trials(trials, "fast", 40, with_pace(2.0));
  add_trials(trials, "a little slower", 40, with_pace(2.06));  // 3 %
  add_trials(trials, "slow", 40, with_pace(2.2));              // 7 % slower than that
  const Discrimination result = only(trials);
  CHECK(result.pairs == 3);
  CHECK(result.separated == 2);
  CHECK(result.at_ceiling == 3);
  CHECK(result.time_effect.partial_eta_squared > 0.9);
  const auto found = misses(result, true);
  REQUIRE(found.size() == 2);
  CHECK(found[0] == "mean 1.00 outside [0.3, 0.9]");
  CHECK(found[1] == "3 of 3 entries at the ceiling");
}

TEST_CASE("entries of several runs: how they differ may depend on the run", "[ranking]") {
  const auto in_run = [](const char* planner, const char* run) { return planner_in_run(planner, run); };
  std::vector<TrialRecord> trials;
  add_trials(trials, in_run("searcher", "free"), 40, arriving(0.5, 1));
  add_trials(trials, in_run("greedy", "free"), 40, arriving(0.5, 2));
  add_trials(trials, in_run("searcher", "ordered"), 40, arriving(1.0, 3));
  add_trials(trials, in_run("greedy", "ordered"), 40, arriving(0.5, 4));
  add_trials(trials, in_run("alone", "free"), 40, arriving(0.2, 5));  // in one run only: no part of the factors
  const std::vector<std::string> runs = {"free", "ordered"};
  const auto found = run_interaction(only(trials), runs);
  REQUIRE(found);
  REQUIRE(found->entries.size() == 2);
  CHECK(found->entries[0] == "P + searcher");
  CHECK(found->effect.partial_eta_squared > 0.1);
  REQUIRE(found->difference);
  CHECK(*found->difference == Approx(0.5).margin(0.15));
  CHECK(found->interval.low > 0.1);
  CHECK_FALSE(run_interaction(only(trials), std::vector<std::string>{"free"}));

  std::vector<TrialRecord> one_each;
  add_trials(one_each, in_run("searcher", "free"), 40, arriving(0.5, 1));
  add_trials(one_each, in_run("searcher", "ordered"), 40, arriving(1.0, 3));
  CHECK_FALSE(run_interaction(only(one_each), runs));
}

}  // namespace discrimination_test
