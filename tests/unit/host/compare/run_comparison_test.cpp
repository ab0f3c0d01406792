// SPDX-License-Identifier: MIT
#include "host/compare/run_comparison.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/errors/input_error.hpp"
#include "tests/unit/host/ranking/ranking_example.hpp"

namespace run_comparison_test {

using namespace dmrp::host;
using namespace dmrp::test;

const std::vector<std::string> names{"done", "time"};

ReportLayouts layouts() {
  return {ranking_layout(), "{}",
          parse_report_layout(R"({"comparisons": [{"metric": "time", "censored": true}]})", "report")};
}

ReportRun run_of(std::vector<TrialRecord> trials) {
  ReportRun run;
  ScenarioFacts& mall = run.manifest.experiment.scenarios.emplace_back();
  mall.name = "mall";
  mall.robots = 2;
  mall.time_limit_s = 100.0;
  run.metrics = ranking_metrics();
  run.trials = std::move(trials);
  return run;
}

// Of so many tasks, this many fail.
std::vector<TrialRecord> with_failures(std::uint32_t failing, std::uint32_t repetitions = 10) {
  std::vector<TrialRecord> trials;
  add_trials(trials, "c", repetitions, [=](std::uint32_t i) {
    return std::vector<RobotResult>{{20.0}, {i < failing ? std::nullopt : std::optional(30.0)}};
  });
  return trials;
}

RunComparison compare(std::uint32_t before, std::uint32_t after, std::uint32_t repetitions = 10) {
  return compare_runs(run_of(with_failures(before, repetitions)), run_of(with_failures(after, repetitions)), layouts(),
                      names);
}

Verdict verdict(const std::string& condition, const RunComparison& comparison) {
  return judge(parse_fail_condition(condition), comparison.metrics.front());
}

TEST_CASE("runs are compared trial by trial", "[compare]") {
  const RunComparison found = compare(0, 4);
  CHECK(found.pairs == 10);
  const MetricComparison& done = found.metrics.at(0);
  CHECK(done.before == 1.0);
  CHECK(done.after == Approx(0.8));
  CHECK(done.difference.over_tasks.mean == Approx(-0.2));
  CHECK(done.difference.over_tasks.interval.low < -0.2);
  CHECK(found.metrics.at(1).after == Approx(52.0));  // four times the limit of 100 s, six times 20 s
}

TEST_CASE("trials are matched by scenario, robots, seed and labels", "[compare]") {
  auto other = with_failures(0);
  other[0].seed = 99;
  other[1].scenario = "office";
  other[2].local_controller = "d";
  other[3].outcome = trial_outcome::skipped;
  const RunComparison found = compare_runs(run_of(with_failures(0)), run_of(other), layouts(), names);
  CHECK(found.pairs == 6);
  CHECK(found.only_before == 4);
  CHECK(found.only_after == 3);
}

TEST_CASE("the pedestrian models of two runs that have one each need not have the same label", "[compare]") {
  auto walked = with_failures(0);
  for (TrialRecord& trial : walked) trial.pedestrian_model = "orca";
  auto empty = with_failures(0);
  for (TrialRecord& trial : empty) trial.pedestrian_model = "";
  const RunComparison found = compare_runs(run_of(walked), run_of(empty), layouts(), names);
  CHECK(found.pairs == 10);
  CHECK(found.combinations.size() == 1);
  walked.front().pedestrian_model = "social force";
  CHECK(compare_runs(run_of(walked), run_of(empty), layouts(), names).pairs == 0);
}

TEST_CASE("combinations on the same task are one observation, and so are its crowds", "[compare]") {
  const auto twice = [](std::uint32_t failing) {
    auto trials = with_failures(failing, 6);
    for (const TrialRecord& trial : with_failures(failing, 6)) {
      trials.push_back(trial);
      trials.back().global_planner = "Q";
    }
    return trials;
  };
  const RunComparison found = compare_runs(run_of(twice(0)), run_of(twice(3)), layouts(), names);
  CHECK(found.metrics[0].pairs == 12);
  CHECK(found.metrics[0].difference.over_tasks.n == 6);

  const auto on_two_tasks = [&](std::uint32_t failing) {
    auto trials = twice(failing);
    for (TrialRecord& trial : trials) trial.task = std::to_string(trial.repetition % 2);
    return run_of(trials);
  };
  const RunComparison crowds = compare_runs(on_two_tasks(0), on_two_tasks(3), layouts(), names);
  CHECK(crowds.metrics[0].pairs == 12);
  CHECK(crowds.metrics[0].difference.over_tasks.n == 2);
  CHECK(std::isnan(crowds.metrics[0].difference.p));
}

TEST_CASE("each combination is compared on its own", "[compare]") {
  const auto both = [](std::uint32_t failing) {
    auto trials = with_failures(0);
    for (const TrialRecord& trial : with_failures(failing)) {
      trials.push_back(trial);
      trials.back().local_controller = "d";
    }
    return run_of(trials);
  };
  const RunComparison found = compare_runs(both(0), both(8), layouts(), names);
  REQUIRE(found.combinations.size() == 2);
  CHECK(found.combinations[0].combination.local_controller == "c");
  CHECK(found.combinations[0].metrics[0].difference.equal);
  CHECK(std::isnan(found.combinations[0].metrics[0].difference.p_holm));
  const MetricComparison& changed = found.combinations[1].metrics[0];
  CHECK(found.combinations[1].combination.local_controller == "d");
  CHECK(changed.pairs == 10);
  CHECK(changed.difference.over_tasks.mean == Approx(-0.4));
  CHECK(changed.difference.p < 0.05);
  CHECK(changed.difference.p_holm >= changed.difference.p);
}

TEST_CASE("plugin libraries are compared by name and hash", "[compare]") {
  ReportRun before = run_of(with_failures(0));
  ReportRun after = before;
  before.manifest.files = {
      {"plugin library", "/a/libone.so", "11"}, {"plugin library", "/a/libtwo.so", "22"}, {"scenario", "x", "0"}};
  after.manifest.files = {{"plugin library", "/b/libone.so", "11"}, {"plugin library", "/b/libthree.so", "33"}};
  const auto libraries = compare_runs(before, after, layouts(), names).libraries;
  REQUIRE(libraries.size() == 3);
  CHECK(libraries[0].name == "libone.so");
  CHECK(libraries[0].before == libraries[0].after);
  CHECK(libraries[1].name == "libthree.so");
  CHECK(libraries[1].before.empty());
  CHECK(libraries[2].after.empty());
}

TEST_CASE("a condition fails, holds, or cannot be decided", "[compare]") {
  CHECK(verdict("done < -0.02", compare(0, 0)) == Verdict::holds);
  CHECK(verdict("done < -0.02", compare(0, 40, 40)) == Verdict::fails);
  CHECK(verdict("done < -0.02", compare(0, 1)) == Verdict::undecided);  // -0.05, with an interval that reaches 0
  CHECK(verdict("done > 0.1", compare(40, 0, 40)) == Verdict::fails);
  CHECK(verdict("done > 0.1", compare(0, 40, 40)) == Verdict::holds);

  SECTION("one task never fails it, but equal runs hold") {
    const auto on_one_task = [](std::uint32_t failing) {
      auto trials = with_failures(failing);
      for (TrialRecord& trial : trials) trial.task = "the same";
      return run_of(trials);
    };
    CHECK(verdict("done < -0.02", compare_runs(on_one_task(0), on_one_task(10), layouts(), names)) ==
          Verdict::undecided);
    CHECK(verdict("done < -0.02", compare_runs(on_one_task(0), on_one_task(0), layouts(), names)) == Verdict::holds);
  }
}

TEST_CASE("conditions are read, or refused", "[compare]") {
  const FailCondition condition = parse_fail_condition(" pfd>+1e-1 ");
  CHECK(condition.metric == "pfd");
  CHECK_FALSE(condition.below);
  CHECK(condition.limit == 0.1);
  for (const char* wrong : {"", "pfd", "pfd = 1", "pfd < x", "pfd < 1 2", "pfd <= 1", "pfd < 1e999", "pfd < -"})
    CHECK_THROWS_AS(parse_fail_condition(wrong), InputError);
}

}  // namespace run_comparison_test
