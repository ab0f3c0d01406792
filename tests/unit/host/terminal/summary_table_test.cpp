// SPDX-License-Identifier: MIT
#include "host/terminal/summary_table.hpp"

#include <catch2/catch.hpp>

#include "host/findings/summary.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace summary_table_test {

using namespace dmrp::host;
using dmrp::test::example_layout;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;
using dmrp::test::two_planners;

std::string table_of(const std::vector<TrialRecord>& trials, const TableStyle& style = {},
                     const std::vector<BestMark>& marks = {}) {
  const auto metrics = example_metrics();
  return summary_table(example_layout(), metrics, summarise(metrics, trials, {}), marks, style);
}

// The marks of two_planners() where they are told apart.
std::vector<BestMark> two_marks() {
  return {{{"mall", 2, "CBS", "DWA", "crowd"}, "time"}, {{"mall", 2, "A*", "DWA", "crowd"}, "speed"}};
}

TEST_CASE("the table of one combination is aligned and marks nothing", "[terminal]") {
  CHECK(table_of({example_trial(0, "CBS", 0, 40.0, 0.5), example_trial(1, "CBS", 1, 43.5, 0.52)}) ==
        "              success   time s    speed m/s   plan ms\n"
        "  CBS + DWA      1.00     41.8   0.51 ±0.17         –\n");
}

TEST_CASE("the best of several is marked", "[terminal]") {
  SECTION("by an asterisk") {
    CHECK(table_of(two_planners(), {}, two_marks()) ==
          "              success   time s     speed m/s   plan ms\n"
          "  CBS + DWA      1.00    41.8*   0.51 ±0.17          –\n"
          "  A* + DWA       1.00    51.0    0.60 ±0.17*         –\n");
  }
  SECTION("in bold on a terminal") {
    const std::string table = table_of(two_planners(), {0, true}, two_marks());
    CHECK(table.find("\x1b[1m  41.8\x1b[0m") != std::string::npos);
    CHECK(table.find("\x1b[1m0.60 ±0.17\x1b[0m") != std::string::npos);
    CHECK(table.find('*') == table.find("A*") + 1);
  }
  SECTION("nothing without a mark") {
    CHECK(table_of(two_planners()).find("* ") == table_of(two_planners()).find("A* ") + 1);
  }
}

TEST_CASE("a value that some trials lack says in how many it is defined", "[terminal]") {
  const std::string table =
      table_of({example_trial(0, "CBS", 0, 40.0, 0.5), example_trial(1, "CBS", 1, std::nullopt, 0.5),
                example_trial(2, "A*", 0, 50.0, 0.5), example_trial(3, "A*", 1, 52.0, 0.5)});
  CHECK(table ==
        "              success       time s    speed m/s   plan ms\n"
        "  CBS + DWA      0.75   40.0 (1/2)   0.50 ±0.17         –\n"
        "  A* + DWA       1.00   51.0         0.50 ±0.17         –\n");
}

TEST_CASE("a column shows the median if its layout says so", "[terminal]") {
  std::vector<TrialRecord> trials;
  for (std::uint32_t i = 0; i < 3; ++i) {
    trials.push_back(example_trial(i, "CBS", i, 40.0, 0.5));
    trials.back().values.push_back({"cpu", DMRP_SUBJECT_SYSTEM, std::nullopt, std::nullopt, i == 2 ? 20.0 : 0.25});
  }
  const auto layout = parse_summary_layout(
      R"({"columns": [{"metric": "cpu", "header": "plan", "median": true, "legend": "planning time"}]})", "layout");
  const auto metrics = example_metrics();
  const std::string table = summary_table(layout, metrics, summarise(metrics, trials, {}), {}, {});
  CHECK(table.find(" 0.25\n") != std::string::npos);
}

TEST_CASE("a legend explains what is shown", "[terminal]") {
  auto layout = example_layout();
  layout.columns[3].legend = "mean over time";
  layout.columns[2].legend = "of a metric that was not measured";
  const auto metrics = example_metrics();
  const auto summaries = summarise(metrics, two_planners(), {});
  CHECK(table_legend(layout, metrics, summaries, met_by_all(two_planners()), {}, {}) ==
        "  means over 2 drawn tasks · speed: mean over time · ±: deviation over time\n");
  CHECK(table_legend(layout, metrics, summaries, met_by_all(two_planners()), two_marks(), {36, false}) ==
        "  means over 2 drawn tasks · speed:\n    mean over time · ±: deviation\n    over time · *: better than all\n  "
        "  others\n");
}

TEST_CASE("a legend names the values of another metric", "[terminal]") {
  auto layout = example_layout();
  layout.columns[3].legend = "after {time} of driving";
  const auto metrics = example_metrics();
  const auto summaries = summarise(metrics, two_planners(), {});
  CHECK_THAT(table_legend(layout, metrics, summaries, met_by_all(two_planners()), {}, {}),
             Catch::Contains("speed: after 41.8, 51 s of driving ·"));
}

TEST_CASE("shares have their intervals, from two observations on", "[terminal]") {
  auto layout = example_layout();
  layout.counts_failures = {"done"};
  const auto metrics = example_metrics();
  auto trials = two_planners();
  const auto table = [&] {
    return summary_table(layout, metrics, summarise(metrics, trials, {layout.counts_failures}), {}, {});
  };
  CHECK_THAT(table(), Catch::Contains("CBS + DWA   1.00 [0."));
  std::erase_if(trials, [](const TrialRecord& trial) { return trial.repetition > 0; });
  CHECK_THAT(table(), !Catch::Contains("["));
}

TEST_CASE("rows that can be compared stand together", "[terminal]") {
  std::vector<TrialRecord> trials = two_planners();
  trials[3] = example_trial(3, "A*", 1, std::nullopt, 0.61);  // failed
  trials[1].scenario = trials[3].scenario = "office";
  trials[1].robots = trials[3].robots = 1;
  CHECK(table_of(trials) ==
        "                success   time s    speed m/s   plan ms\n"
        "  mall · 2 robots\n"
        "    CBS + DWA      1.00     40.0   0.50 ±0.17         –\n"
        "    A* + DWA       1.00     50.0   0.60 ±0.17         –\n"
        "  office · 1 robot\n"
        "    CBS + DWA      1.00     43.5   0.52 ±0.17         –\n"
        "    A* + DWA       0.50        –   0.61 ±0.17         –\n");
}

TEST_CASE("a table that is too wide continues below", "[terminal]") {
  const std::string table = table_of({example_trial(0, "CBS", 0, 41.75, 0.51)}, {45, false});
  CHECK(table ==
        "              success   time s    speed m/s\n"
        "  CBS + DWA      1.00     41.8   0.51 ±0.17\n"
        "\n"
        "              plan ms\n"
        "  CBS + DWA         –\n");
}

TEST_CASE("no trials, no table", "[terminal]") {
  CHECK(table_of({}).empty());
}

}  // namespace summary_table_test
