// SPDX-License-Identifier: MIT
// Tests with levels: thresholds by combination, and their words.
#include "host/ranking/graded_series.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace graded_series_test {

using namespace dmrp::host;
using namespace dmrp::test;

ScenarioFacts level_of(const std::string& series, double level, const std::string& name, bool harder_when_higher) {
  ScenarioFacts facts;
  facts.name = name;
  facts.title = "A test";
  facts.series = series;
  facts.quantity = "width";
  facts.unit = "m";
  facts.harder_when_higher = harder_when_higher;
  facts.level = level;
  return facts;
}

// `successes` of 20 trials with one robot.
void add_level(std::vector<TrialRecord>& trials, const std::string& scenario, std::uint32_t successes) {
  const std::size_t before = trials.size();
  add_trials(trials, "C", 20, [&](std::uint32_t i) {
    return std::vector<RobotResult>{{i < successes ? std::optional(20.0) : std::nullopt, true, 10.0}};
  });
  for (std::size_t i = before; i < trials.size(); ++i) trials[i].scenario = scenario;
}

TEST_CASE("levels are put from hard to easy, and a combination gets its threshold", "[ranking]") {
  const std::vector<ScenarioFacts> facts = {
      level_of("door", 0.8, "door 0.8", false), level_of("door", 0.6, "door 0.6", false),
      level_of("door", 0.7, "door 0.7", false), level_of("crowd (people 2)", 1.0, "crowd 1", true),
      level_of("crowd (people 2)", 0.5, "crowd 0.5", true)};
  std::vector<TrialRecord> trials;
  add_level(trials, "door 0.8", 20);
  add_level(trials, "door 0.6", 2);
  add_level(trials, "door 0.7", 6);
  add_level(trials, "crowd 1", 20);
  add_level(trials, "crowd 0.5", 20);
  add_level(trials, "elsewhere", 3);
  const auto series = graded_series(ranking_layout(), facts, trials);
  REQUIRE(series.size() == 2);
  CHECK(series[0].title == "A test");
  CHECK(series[1].title == "A test (people 2)");
  CHECK(series[0].levels == std::vector{0.6, 0.7, 0.8});
  CHECK(series[0].scenarios == std::vector<std::string>{"door 0.6", "door 0.7", "door 0.8"});
  REQUIRE(series[0].results.size() == 1);
  const GradedResult& door = series[0].results[0];
  CHECK(door.means == std::vector{0.1, 0.3, 1.0});
  CHECK(door.estimate.threshold.level == Approx(0.7 + 0.1 * 0.2 / 0.7));
  CHECK(door.estimate.low.level <= door.estimate.threshold.level);
  CHECK_THAT(threshold_words(series[0], door.estimate), Catch::StartsWith("0.729 [0.7") && Catch::EndsWith("] m"));
  CHECK(series[1].levels == std::vector{1.0, 0.5});
  CHECK(threshold_words(series[1], series[1].results[0].estimate) == "≥ 1 m");
}

TEST_CASE("a repetition is passed if all of its robots are", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "C", 20, [](std::uint32_t) {
    return std::vector<RobotResult>{{20.0, true, 10.0}, {std::nullopt, true, 10.0}};
  });
  for (TrialRecord& trial : trials) trial.scenario = "aisle 1";
  const auto series = graded_series(ranking_layout(), std::vector{level_of("aisle", 1.0, "aisle 1", false)}, trials);
  REQUIRE(series.size() == 1);
  CHECK(series[0].results[0].means == std::vector{0.0});
  CHECK(threshold_words(series[0], series[0].results[0].estimate) == "> 1 m");
}

TEST_CASE("runs without levels have no series", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_level(trials, "mall", 3);
  ScenarioFacts mall;
  mall.name = "mall";
  CHECK(graded_series(ranking_layout(), std::vector{mall}, trials).empty());
}

}  // namespace graded_series_test
