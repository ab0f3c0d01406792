// SPDX-License-Identifier: MIT
#include "host/findings/summary.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/results/summary_layout.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace summary_test {

using namespace dmrp::host;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;

TEST_CASE("trials are summarised by combination", "[results]") {
  std::vector<TrialRecord> trials{example_trial(0, "A", 0, 40.0, 0.5), example_trial(1, "B", 0, 50.0, 0.5),
                                  example_trial(2, "A", 1, 44.0, 0.5), example_trial(3, "A", 2, std::nullopt, 0.5),
                                  example_trial(4, "A", 3, 40.0, 0.5), example_trial(5, "A", 4, 40.0, 0.5)};
  trials.back().outcome = trial_outcome::skipped;
  const auto summaries = summarise(example_metrics(), trials, {});
  REQUIRE(summaries.size() == 2);
  CHECK(summaries[0].combination.global_planner == "A");
  CHECK(summaries[0].trials == 4);
  CHECK(summaries[1].trials == 1);

  const MetricSummary& time = summaries[0].metrics[1];  // 40, 44, 40
  CHECK(time.defined == 3);
  CHECK(time.mean == Approx(124.0 / 3.0));
  CHECK(time.sd == Approx(std::sqrt(16.0 / 3.0)));
  CHECK(time.median == 40.0);
  CHECK(time.n == 3);
  CHECK(std::isnan(time.interval.low));  // ten tasks have one
  CHECK(time.paper.mean == Approx(124.0 / 3.0));

  const MetricSummary& done = summaries[0].metrics[0];  // 1, 1, 0.5, 1; the paper's rule leaves the failed one out
  CHECK(done.mean == 0.875);
  CHECK(done.paper.mean == 1.0);
  CHECK(done.paper.count == 3);

  const MetricSummary& cpu = summaries[0].metrics[5];  // never measured
  CHECK(cpu.defined == 0);
  CHECK(std::isnan(cpu.mean));
  CHECK(std::isnan(summaries[1].metrics[1].sd));
}

TEST_CASE("five tasks under five seeds each are five observations", "[results]") {
  std::vector<TrialRecord> trials;
  for (std::uint32_t i = 0; i < 25; ++i) {
    // tasks 0 and 1 fail with one crowd of five, the others never
    trials.push_back(example_trial(i, "A", i, i < 2 ? std::nullopt : std::optional(40.0), 0.5));
    trials.back().task = std::to_string(i % 5);
  }
  const std::vector<std::string> shares{"done"};
  const MetricSummary done = summarise(example_metrics(), trials, {shares})[0].metrics[0];
  CHECK(done.n == 5);
  CHECK(done.defined == 25);
  CHECK(done.mean == Approx(0.96));

  SECTION("with the interval of five trials that have the tasks' means") {
    std::vector<TrialRecord> means;
    for (std::uint32_t i = 0; i < 5; ++i) {
      means.push_back(example_trial(i, "A", i, 40.0, 0.5));
      means.back().values[0].value = i < 2 ? 0.9 : 1.0;
    }
    const MetricSummary same = summarise(example_metrics(), means, {shares})[0].metrics[0];
    CHECK(same.interval.low == Approx(done.interval.low));
    CHECK(same.interval.high == Approx(done.interval.high));
  }
}

TEST_CASE("an interval stays within what a metric can be, and none had any is said by the rule of three", "[results]") {
  std::vector<MetricColumn> metrics = example_metrics();
  std::vector<TrialRecord> trials;
  for (std::uint32_t i = 0; i < 20; ++i) trials.push_back(example_trial(i, "A", i, 40.0, 0.5));
  const auto touches_of = [&](std::uint32_t with_some) {
    for (std::uint32_t i = 0; i < 20; ++i)
      for (MetricValue& value : trials[i].values)
        if (value.metric == "touches") value.value = i < with_some ? 3.0 : 0.0;
    return summarise(metrics, trials, {})[0].metrics[4];
  };
  CHECK(touches_of(2).interval.low < 0.0);
  CHECK(std::isnan(touches_of(0).at_most));  // not known to be never negative
  metrics[4].minimum = 0.0;
  CHECK(touches_of(2).interval.low == 0.0);
  CHECK(touches_of(2).interval.high > 0.3);
  CHECK(std::isnan(touches_of(2).at_most));
  CHECK(std::isnan(touches_of(0).interval.high));
  CHECK(touches_of(0).at_most == Approx(0.139).margin(1e-3));
}

TEST_CASE("crowds that meet listed tasks are observations", "[results]") {
  std::vector<TrialRecord> trials;
  for (std::uint32_t i = 0; i < 20; ++i) {
    trials.push_back(example_trial(i, "A", i, 40.0, 0.5));
    trials.back().task = "listed";
    trials.back().task_is_drawn = false;
  }
  const auto time_of = [&] { return summarise(example_metrics(), trials, {})[0].metrics[1]; };
  CHECK(time_of().n == 20);
  CHECK(met_words(time_of().met) == "one task, 20 crowds");
  const std::vector<std::string> of_plans{"time"};
  const MetricSummary of_plan = summarise(example_metrics(), trials, {{}, of_plans})[0].metrics[1];
  CHECK(of_plan.n == 1);  // one plan, copied
  CHECK(std::isnan(of_plan.interval.low));

  SECTION("of several worlds, too") {
    for (const char* world : {"library", "office"})
      for (std::uint32_t i = 0; i < 20; ++i) {
        trials.push_back(trials[i]);
        trials.back().scenario = world;
      }
    CHECK(met_words(met_by_all(trials)) == "3 tasks x 20 crowds");
    CHECK(observation_name(met_by_all(trials)) == "crowd");
  }
  SECTION("and where tasks are drawn, each is one with all its crowds") {
    for (std::uint32_t i = 0; i < 20; ++i) {
      trials[i].task = "drawn " + std::to_string(i % 10);
      trials[i].task_is_drawn = true;
    }
    CHECK(time_of().n == 10);
    CHECK(met_words(time_of().met) == "10 drawn tasks x 2 crowds");
    CHECK(observation_name(time_of().met) == "task");
  }
}

TEST_CASE("what trials have met has words", "[results]") {
  CHECK(met_words({1, 0, 1, 1, true}) == "one task, one crowd");
  CHECK(met_words({40, 40, 40, 40, true}) == "40 drawn tasks");
  CHECK(met_words({1, 1, 1, 1, true}) == "one drawn task");
  CHECK(met_words({2, 0, 30, 30, true}) == "2 tasks x 15 crowds");
  CHECK(met_words({2, 0, 31, 31, true}) == "2 tasks, 31 crowds");
  CHECK(met_words({43, 40, 100, 100, true}) == "43 tasks, 40 of them drawn, 100 crowds");
  CHECK(met_words({1, 0, 20, 20, false}) == "one task, 20 seeds");
}

TEST_CASE("failed trials count in metrics that count failures", "[results]") {
  std::vector<TrialRecord> trials{example_trial(0, "A", 0, 40.0, 0.5), example_trial(1, "A", 1, std::nullopt, 0.5),
                                  example_trial(2, "A", 2, 44.0, 0.5)};
  trials.back().outcome = trial_outcome::fault;
  trials.back().values.clear();  // a trial that ended in a fault has none
  const std::vector<std::string> failure_metrics{"done"};
  const auto summaries = summarise(example_metrics(), trials, {failure_metrics});
  const MetricSummary& done = summaries[0].metrics[0];  // 1, 0.5, 0
  CHECK(done.defined == 3);
  CHECK(done.mean == 0.5);
  CHECK(done.paper.count == 3);
  CHECK(summaries[0].metrics[1].defined == 1);  // time: only the first has one
}

TEST_CASE("summary.csv has a line for each combination and metric", "[results]") {
  const std::vector<MetricColumn> metrics{example_metrics()[1], example_metrics()[5]};
  const std::vector<TrialRecord> trials{example_trial(0, "A", 0, 40.0, 0.5), example_trial(1, "A", 1, 40.0, 0.5)};
  CHECK(summary_csv(metrics, summarise(metrics, trials, {})) ==
        "scenario,robots,global_planner,local_controller,pedestrian_model,metric,unit,tasks,crowds,n,n_defined,mean,sd,"
        "median,"
        "ci_low,ci_high,paper_mean,paper_n,paper_trimmed_all_nonzero,trials\n"
        "mall,2,A,DWA,crowd,time,s,2,2,2,2,40,0,40,,,40,2,0,2\n"
        "mall,2,A,DWA,crowd,cpu,ms,0,0,0,0,,,,,,,0,0,2\n");
}

TEST_CASE("layouts are checked", "[results]") {
  CHECK_THROWS_WITH(parse_summary_layout("{\"colums\": []}", "a.json"), "a.json: unknown key 'colums'");
  CHECK_THROWS_WITH(parse_summary_layout("{\"columns\": [{\"header\": \"x\"}]}", "a.json"),
                    "a.json: a column without 'metric'");
  CHECK_THROWS_WITH(parse_summary_layout("{\"columns\": [{\"metric\": 3}]}", "a.json"), Catch::Contains("a.json"));
  CHECK_THROWS_WITH(parse_summary_layout("{", "a.json"), Catch::Contains("a.json"));
  CHECK_THROWS_WITH(read_summary_layout("/nowhere/a.json"), Catch::Contains("/nowhere/a.json"));
  const SummaryLayout shipped = read_summary_layout(DMRP_SUMMARY_LAYOUT);
  CHECK(shipped.answer.shares == std::vector<std::string>{"safe_sct", "safe_success"});
  CHECK(shipped.answer.safe == "safe_success");
  CHECK(shipped.columns.size() == 9);
  CHECK_FALSE(shipped.arrived.empty());
}

}  // namespace summary_test
