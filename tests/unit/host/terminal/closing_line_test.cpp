// SPDX-License-Identifier: MIT
#include "host/terminal/closing_line.hpp"

#include <catch2/catch.hpp>

#include "tests/unit/host/results/results_example.hpp"

namespace closing_line_test {

using namespace dmrp::host;
using dmrp::test::example_layout;
using dmrp::test::example_trial;
using dmrp::test::two_planners;

TEST_CASE("the closing line counts", "[terminal]") {
  const SummaryLayout layout = example_layout();
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // failed
  CHECK(closing_line(layout, trials) == "7 of 8 robots arrived · 0 contacts · 0 faults · repeatable");

  MetricEvent excluded;
  excluded.metric = layout.arrived;
  excluded.text = "robot 1 failed: excluded for oscillation";
  trials[3].events.push_back(excluded);
  CHECK(closing_line(layout, trials) ==
        "8 of 8 robots arrived; 1 of them is excluded for oscillation · 0 contacts · 0 faults · repeatable");
  trials[3].events.clear();

  trials[0].repeatable = false;
  trials[0].values.back().value = 1.0;
  trials[1].outcome = trial_outcome::fault;
  trials[1].faults.push_back({"crash", "x", "step", 1, 0, 11, "", ""});
  trials[2].outcome = trial_outcome::skipped;
  CHECK(closing_line(layout, trials) ==
        "5 of 6 robots arrived · 1 contact · 1 fault · 1 trial skipped · 1 trial not repeatable");

  for (TrialRecord& trial : trials) trial.values.clear();
  trials[0].repeatable = true;
  CHECK(closing_line(layout, trials) == "1 fault · 1 trial skipped · repeatable");
}

TEST_CASE("a line tells which tasks are drawn", "[terminal]") {
  ScenarioFacts two;
  two.name = "office";
  two.robots = 2;
  CHECK(drawn_tasks_line({}).empty());
  CHECK(drawn_tasks_line(std::vector{two}).empty());
  two.tasks_drawn = true;
  ScenarioFacts sixteen = two;
  sixteen.robots = 16;
  ScenarioFacts listed = two;
  listed.tasks_drawn = false;
  ScenarioFacts mall = two;
  mall.name = "mall";
  mall.robots = 1;
  CHECK(drawn_tasks_line(std::vector{two, sixteen, listed, mall}) ==
        "drawn tasks: office with 2, 16 robots; mall with 1 robot");
}

TEST_CASE("the run directory is printed with its files", "[terminal]") {
  const std::vector<std::string> files{"results.sqlite", "traces/"};
  CHECK(files_line("runs/quickstart", files) == "runs/quickstart   results.sqlite  traces/");
}

}  // namespace closing_line_test
