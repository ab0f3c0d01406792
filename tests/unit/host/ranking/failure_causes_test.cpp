// SPDX-License-Identifier: MIT
#include "host/ranking/failure_causes.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace failure_causes_test {

using namespace dmrp::host;
using namespace dmrp::test;

TEST_CASE("failures are counted by combination and cause", "[ranking]") {
  const RobotResult fails{std::nullopt, true, 10.0};
  const RobotResult touches{20.0, false, 10.0};
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 3, [&](std::uint32_t i) {
    return i == 0 ? std::vector<RobotResult>{fails, fails} : std::vector<RobotResult>{fails, touches};
  });
  add_trials(trials, "b", 1, [](std::uint32_t) { return std::vector<RobotResult>{{}, {}}; });
  trials[2].events.back().text = "robot 0 failed: no plan";
  trials[3].outcome = trial_outcome::fault;
  trials[3].values.clear();

  const auto failures = failure_causes(ranking_layout(), trials);
  REQUIRE(failures.size() == 2);
  CHECK(failures[0].combination.local_controller == "a");
  CHECK(failures[0].robots == 6);
  REQUIRE(failures[0].causes.size() == 2);
  CHECK(failures[0].causes[0].cause == "deadlock");
  CHECK(failures[0].causes[0].robots == 3);
  CHECK(failures[0].causes[0].trials == std::vector<std::uint64_t>{0, 1});
  CHECK(failures[0].causes[1].cause == "no plan");
  CHECK(failures[0].contact.robots == 2);
  CHECK(failures[0].contact.trials == std::vector<std::uint64_t>{1, 2});
  CHECK(failures[1].causes[0].cause == "fault");
  CHECK(failures[1].causes[0].robots == 2);
  CHECK(failures_line(failures) == "6 did not arrive: 3 deadlock, 2 fault, 1 no plan");

  trials[2].events.back().text = "robot 0 failed: excluded for oscillation";
  CHECK(failures_line(failure_causes(ranking_layout(), trials)) == "5 did not arrive: 3 deadlock, 2 fault");
  CHECK(excluded_robots("done", trials[2]) == 1);
}

TEST_CASE("contacts of robots that failed are counted, too", "[ranking]") {
  SummaryLayout layout = ranking_layout();
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 1, [](std::uint32_t) { return std::vector<RobotResult>(3, {std::nullopt, true, 10.0}); });
  for (const std::uint64_t robot : {0u, 1u, 2u})
    trials[0].values.push_back({"hits", DMRP_SUBJECT_ROBOT, robot, std::nullopt, robot < 2 ? 2.0 - robot : 0.0});
  CHECK(failures_line(failure_causes(layout, trials)) == "3 did not arrive: 3 deadlock");
  layout.at_fault = "hits";
  CHECK(failures_line(failure_causes(layout, trials)) == "3 did not arrive: 3 deadlock (2 after a contact)");
}

TEST_CASE("the robots that others wait for are counted once a trial and cause", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 2, [](std::uint32_t) {
    const RobotResult fails{std::nullopt, true, 10.0};
    return std::vector<RobotResult>(5, fails);
  });
  for (TrialRecord& trial : trials)
    for (std::uint32_t robot = 0; robot < 4; ++robot) {
      trial.events[robot].text = "robot " + std::to_string(robot) + " failed: held behind another robot";
      trial.events[robot].robots.push_back(robot < 3 ? 4 : 9);
    }
  const auto failures = failure_causes(ranking_layout(), trials);
  REQUIRE(failures.size() == 1);
  CHECK(failures[0].causes[0].robots == 8);
  CHECK(failures[0].causes[0].roots == 4);
  CHECK(failures[0].causes[1].roots == 0);
  CHECK(failures_line(failures) == "10 did not arrive: 8 held behind another robot (by 4 robots), 2 deadlock");
}

TEST_CASE("robots that arrive after standstills which run on are counted", "[ranking]") {
  SummaryLayout layout = ranking_layout();
  layout.after_standstill = "after_standstill";
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 3, [](std::uint32_t) { return std::vector<RobotResult>(2); });
  CHECK(standstills_line(layout, trials).empty());
  const auto add_value = [&](std::size_t trial, std::uint64_t robot, double value) {
    MetricValue one = trials[trial].values.front();
    one.metric = layout.after_standstill;
    one.subject_kind = DMRP_SUBJECT_ROBOT;
    one.subject = robot;
    one.value = value;
    trials[trial].values.push_back(one);
  };
  add_value(1, 1, 0.0);
  CHECK(standstills_line(layout, trials) ==
        "Of 1 robot at standstills that ran on to the time limit, 0 arrived after all");
  add_value(0, 0, 1.0);
  add_value(0, 1, 0.0);
  CHECK(standstills_line(layout, trials) ==
        "Of 3 robots at standstills that ran on to the time limit, 1 arrived after all");
}

TEST_CASE("there is nothing to say where all arrived", "[ranking]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "a", 2, [](std::uint32_t) { return std::vector<RobotResult>{{}, {}}; });
  CHECK(failures_line(failure_causes(ranking_layout(), trials)).empty());
}

}  // namespace failure_causes_test
