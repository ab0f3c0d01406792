// SPDX-License-Identifier: MIT
#include "host/results/summary.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "host/terminal/closing_line.hpp"
#include "host/terminal/display_width.hpp"
#include "host/terminal/summary_table.hpp"
#include "tests/unit/host/results/results_example.hpp"

using namespace dmrp::host;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;

namespace {

SummaryLayout example_layout() {
  return parse_summary_layout(R"({
    "columns": [
      {"metric": "done", "header": "success", "decimals": 2},
      {"metric": "time", "decimals": 1},
      {"metric": "not measured", "header": "gone"},
      {"metric": "speed", "decimals": 2, "spread": "speed_sd"},
      {"metric": "cpu", "header": "plan", "decimals": 2}
    ],
    "arrived": "done",
    "contacts": "touches"
  })",
                              "layout");
}

std::string table_of(const std::vector<TrialRecord>& trials, const TableStyle& style = {}) {
  const auto metrics = example_metrics();
  return summary_table(example_layout(), metrics, summarise(metrics, trials, {}), style);
}

const std::vector<TrialRecord>& two_planners() {
  static const std::vector<TrialRecord> trials{
      example_trial(0, "CBS", 0, 40.0, 0.5), example_trial(1, "CBS", 1, 43.5, 0.52),
      example_trial(2, "A*", 0, 50.0, 0.6), example_trial(3, "A*", 1, 52.0, 0.61)};
  return trials;
}

}  // namespace

TEST_CASE("trials are summed up by combination", "[results]") {
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
  CHECK(time.interval.low == 40.0);
  CHECK(time.interval.high == Approx(44.0).margin(1.4));  // three draws of 44 have a probability of 1/27
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

TEST_CASE("failing counts where a metric is about failing", "[results]") {
  std::vector<TrialRecord> trials{example_trial(0, "A", 0, 40.0, 0.5), example_trial(1, "A", 1, std::nullopt, 0.5),
                                  example_trial(2, "A", 2, 44.0, 0.5)};
  trials.back().outcome = trial_outcome::fault;
  trials.back().values.clear();  // a trial that ended in a fault has none
  const std::vector<std::string> about_failing{"done"};
  const auto summaries = summarise(example_metrics(), trials, about_failing);
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
        "scenario,robots,global_planner,local_controller,pedestrian_model,metric,unit,n,n_defined,mean,sd,median,"
        "ci_low,ci_high,paper_mean,paper_n,paper_trimmed_all_nonzero\n"
        "mall,2,A,DWA,crowd,time,s,2,2,40,0,40,40,40,40,2,0\n"
        "mall,2,A,DWA,crowd,cpu,ms,2,0,,,,,,,0,0\n");
}

TEST_CASE("the table of one combination is aligned and marks nothing", "[results]") {
  CHECK(table_of({example_trial(0, "CBS", 0, 40.0, 0.5), example_trial(1, "CBS", 1, 43.5, 0.52)}) ==
        "              success   time s    speed m/s   plan ms\n"
        "  CBS + DWA      1.00     41.8   0.51 ±0.17         –\n");
}

TEST_CASE("the best of several is marked", "[results]") {
  SECTION("by an asterisk") {
    CHECK(table_of(two_planners()) ==
          "              success   time s     speed m/s   plan ms\n"
          "  CBS + DWA      1.00    41.8*   0.51 ±0.17          –\n"
          "  A* + DWA       1.00    51.0    0.60 ±0.17*         –\n");
  }
  SECTION("in bold on a terminal") {
    const std::string table = table_of(two_planners(), {0, true});
    CHECK(table.find("\x1b[1m  41.8\x1b[0m") != std::string::npos);
    CHECK(table.find("\x1b[1m0.60 ±0.17\x1b[0m") != std::string::npos);
    CHECK(table.find('*') == table.find("A*") + 1);
  }
  SECTION("but not where all look alike") {
    const std::string table =
        table_of({example_trial(0, "CBS", 0, 40.01, 0.5), example_trial(1, "PBS", 0, 40.02, 0.5)});
    CHECK(table.find('*') == std::string::npos);
  }
}

TEST_CASE("only what is comparable is compared", "[results]") {
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // failed
  trials[1].scenario = trials[3].scenario = "office";
  trials[1].robots = trials[3].robots = 1;
  CHECK(table_of(trials) ==
        "                success   time s     speed m/s   plan ms\n"
        "  mall · 2 robots\n"
        "    CBS + DWA     1.00     40.0*   0.50 ±0.17          –\n"
        "    A* + DWA      1.00     50.0    0.60 ±0.17*         –\n"
        "  office · 1 robot\n"
        "    CBS + DWA     1.00*    43.5    0.52 ±0.17          –\n"
        "    A* + DWA      0.50        –    0.61 ±0.17          –\n");
}

TEST_CASE("a table that is too wide goes on below", "[results]") {
  const std::string table = table_of({example_trial(0, "CBS", 0, 41.75, 0.51)}, {45, false});
  CHECK(table ==
        "              success   time s    speed m/s\n"
        "  CBS + DWA      1.00     41.8   0.51 ±0.17\n"
        "\n"
        "              plan ms\n"
        "  CBS + DWA         –\n");
}

TEST_CASE("no trials, no table", "[results]") {
  CHECK(table_of({}).empty());
}

TEST_CASE("the closing line counts", "[results]") {
  const SummaryLayout layout = example_layout();
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // failed
  CHECK(closing_line(layout, trials) == "7 of 8 robots arrived · 0 contacts · 0 faults · repeatable");

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

TEST_CASE("the run directory comes with its files", "[results]") {
  const std::vector<std::string> files{"results.sqlite", "traces/"};
  CHECK(files_line("runs/quickstart", files) == "runs/quickstart   results.sqlite  traces/");
}

TEST_CASE("layouts are checked", "[results]") {
  CHECK_THROWS_WITH(parse_summary_layout("{\"colums\": []}", "a.json"), "a.json: unknown key 'colums'");
  CHECK_THROWS_WITH(parse_summary_layout("{\"columns\": [{\"header\": \"x\"}]}", "a.json"),
                    "a.json: a column without 'metric'");
  CHECK_THROWS_WITH(parse_summary_layout("{\"columns\": [{\"metric\": 3}]}", "a.json"), Catch::Contains("a.json"));
  CHECK_THROWS_WITH(parse_summary_layout("{", "a.json"), Catch::Contains("a.json"));
  CHECK_THROWS_WITH(read_summary_layout("/nowhere/a.json"), Catch::Contains("/nowhere/a.json"));
  const SummaryLayout shipped = read_summary_layout(DMRP_SUMMARY_LAYOUT);
  CHECK(shipped.columns.size() == 9);
  CHECK_FALSE(shipped.arrived.empty());
}

TEST_CASE("texts are as wide as a terminal shows them", "[results]") {
  CHECK(display_width("") == 0);
  CHECK(display_width("abc") == 3);
  CHECK(display_width("±0.17 – ö") == 9);
  CHECK(display_width("e\xCC\x81") == 1);                 // e with a combining accent
  CHECK(display_width("\xE6\xBC\xA2\xE5\xAD\x97") == 4);  // two ideographs
  CHECK(display_width("\xF0\x9F\xA4\x96") == 2);          // a robot's face
  CHECK(display_width("\xFF\xC3") == 2);                  // no UTF-8
  CHECK(pad_left("±1", 4) == "  ±1");
  CHECK(pad_right("ö", 3) == "ö  ");
  CHECK(pad_left("long", 2) == "long");
}
