// SPDX-License-Identifier: MIT
// Worlds that are not known to tell planners or controllers apart are named, once for each factor that varies.
#include "host/ranking/tested_worlds.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace tested_worlds_test {

using namespace dmrp::host;
using namespace dmrp::test;

const std::vector<TestedWorld> tested = {
    {"mall", 16, 12, "planners", true}, {"mall", 8, 60, "controllers", true}, {"library", 16, 8, "planners", false}};

TrialRecord trial_in(const std::string& scenario, std::uint32_t robots, const std::string& planner) {
  TrialRecord trial = ranking_trial(planner, "DWA", 0, {{20.0, true, 10.0}});
  trial.scenario = scenario;
  trial.robots = robots;
  return trial;
}

std::vector<std::string> sentences(const std::string& scenario, std::uint32_t robots, std::uint32_t people) {
  const std::vector<ScenarioFacts> facts = {{scenario, "", "", robots, people}};
  const std::vector<TrialRecord> trials = {trial_in(scenario, robots, "CBS"), trial_in(scenario, robots, "SIPP")};
  return sanity_only(tested, facts, trials);
}

TEST_CASE("a world that failed its test, or is easier than the tested one, is for sanity only", "[ranking]") {
  CHECK(sentences("mall", 16, 12).empty());
  CHECK(sentences("mall", 20, 30).empty());
  CHECK(
      sentences("mall", 4, 12) ==
      std::vector<std::string>{
          "sanity only: not shown to tell planners apart: mall with 4 robots and 12 people (docs/discrimination.md)"});
  CHECK(sentences("mall", 16, 1).front().find("16 robots and 1 person") != std::string::npos);
  CHECK(sentences("library", 20, 8).size() == 1);
  CHECK(sentences("somebody's own", 4, 2).empty());
}

TEST_CASE("what does not vary, or has no robots, is not spoken of", "[ranking]") {
  const std::vector<ScenarioFacts> facts = {{"mall", "", "", 4, 12}, {"mall", "", "", 0, 12}};
  CHECK(sanity_only(tested, facts, std::vector{trial_in("mall", 4, "CBS"), trial_in("mall", 0, "")}).empty());
  TrialRecord teb = trial_in("mall", 4, "CBS");
  teb.local_controller = "TEB";
  const auto found = sanity_only(tested, facts, std::vector{trial_in("mall", 4, "CBS"), teb});
  REQUIRE(found.size() == 1);
  CHECK(found[0].find("tell controllers apart: mall with 4 robots and 12 people (") != std::string::npos);
}

TEST_CASE("the table of tested worlds is read with its mistakes", "[ranking]") {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("dmrp_tested_worlds_" + std::to_string(::getpid()));
  const auto read = [&](const std::string& text) {
    std::ofstream(path) << text;
    return read_tested_worlds(path);
  };
  const auto rows =
      read(R"({"rows": [{"scenario": "mall", "robots": 16, "people": 12, "factor": "planners", "passes": true}]})");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].scenario == "mall");
  CHECK(rows[0].passes);
  CHECK_THROWS_WITH(
      read(R"({"rows": [{"scenario": "mall", "robots": 16, "people": 12, "factor": "plans", "passes": true}]})"),
      Catch::Contains("unknown factor 'plans'"));
  std::filesystem::remove(path);
}

}  // namespace tested_worlds_test
