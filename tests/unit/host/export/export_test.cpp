// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>

#include "host/errors/input_error.hpp"
#include "host/export/mean_table.hpp"
#include "host/export/table_figure.hpp"
#include "host/export/trial_filter.hpp"
#include "host/export/trials_table.hpp"
#include "tests/unit/host/ranking/ranking_example.hpp"

namespace export_test {

using namespace dmrp::host;
using namespace dmrp::test;
using Catch::Matchers::Contains;

constexpr const char* effective = R"(
[[global_planner]]
use = "org.planner"
label = "P"
[[global_planner]]
file = "/home/ann/plans.csv"
label = "plans"
[[local_controller]]
use = "org.dwa"
label = "slow"
[local_controller.params]
speed = 0.5
mode = "a, b"
[[local_controller]]
use = "org.dwa"
label = "fast"
[local_controller.params]
speed = 1.0
mode = "a, b"
[[local_controller]]
use = "org.other"
label = "other"
[simulation]
step_s = 0.02
[robot]
lidar = { beams = 360 }
)";

// Ten trials each of a slow and a fast controller with two robots, and of the fast one with four.
std::vector<TrialRecord> example() {
  std::vector<TrialRecord> trials;
  add_trials(trials, "slow", 10, [](std::uint32_t i) {
    return std::vector<RobotResult>{{40.0 + i}, i < 5 ? RobotResult{std::nullopt} : RobotResult{}};
  });
  add_trials(trials, "fast", 10, [](std::uint32_t) { return std::vector<RobotResult>{{20.0}, {20.0}}; });
  add_trials(trials, "fast", 10, [](std::uint32_t) { return std::vector<RobotResult>{{}, {}, {}, {std::nullopt}}; });
  return trials;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST_CASE("each trial has the parameters of its plugins and the settings", "[export]") {
  const RunSettings settings(effective, {});
  TrialRecord fast;
  fast.global_planner = "P";
  fast.local_controller = "fast";
  TrialRecord other = fast;
  other.local_controller = "other";
  CHECK(settings.value("local_controller.speed", fast) == "1");
  CHECK(settings.value("local_controller.id", fast) == "org.dwa");
  CHECK(settings.value("global_planner.id", fast) == "org.planner");
  other.global_planner = "plans";
  CHECK(settings.value("global_planner.id", other) == "file");
  CHECK(settings.value("robot.lidar.beams", fast) == "360");
  CHECK(settings.value("local_controller.speed", other).empty());

  const std::string csv = trials_table_csv(ranking_metrics(), example(), settings);
  CHECK_THAT(csv, Contains("local_controller.mode"));
  CHECK_THAT(csv, Contains("simulation.step_s"));
  CHECK_THAT(csv, Contains("time [s],length [m]"));
  CHECK_THAT(csv, Contains(R"("a, b")"));
  CHECK(count_of(csv, "\n") == 31);
}

TEST_CASE("a table has the means of the trials that agree in its labels", "[export]") {
  SummaryTableColumn done{"done", "success", 2, "", false, ""};
  SummaryTableColumn time{"time", "time", 1, "", false, ""};
  const MeanTable table = make_mean_table({"t", "Results", {Label::local_controller}, {Label::robots}, {done, time}},
                                          ranking_layout(), ranking_metrics(), example());
  CHECK(table.spans == std::vector<std::string>{"2 robots", "4 robots"});
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].name == "slow");
  CHECK(*table.rows[0].cells[0].value == Approx(0.75));
  CHECK(*table.rows[0].cells[1].value == Approx(47.0));  // of the five trials in which both arrive: 45 to 49
  CHECK(table.rows[0].cells[1].defined == 5);
  CHECK_FALSE(table.rows[0].cells[2].value);  // no trials with four robots
  CHECK(*table.rows[1].cells[2].value == Approx(0.75));

  const std::string latex = latex_table(table);
  CHECK_THAT(latex, Contains("\\multicolumn{2}{c}{2 robots} & \\multicolumn{2}{c}{4 robots}"));
  CHECK_THAT(latex, Contains("slow & 0.75 [0."));
  CHECK_THAT(latex, Contains("] & 47.0\\,(5/10) & -- & -- \\\\"));
  CHECK_THAT(latex, Contains("Results: means over 10 drawn tasks. In brackets: 95 \\% intervals over tasks."));
}

TEST_CASE("a column of medians is not moved by one slow trial", "[export]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "steady", 5, [](std::uint32_t i) { return std::vector<RobotResult>{{i == 2 ? 90.0 : 45.0}}; });
  SummaryTableColumn time{"time", "time", 1, "", false, ""};
  const TableSpec mean = {"t", "Results", {Label::local_controller}, {}, {time}};
  TableSpec median = mean;
  median.metrics[0].median = true;
  const auto table_of = [&](const TableSpec& spec) {
    return make_mean_table(spec, ranking_layout(), ranking_metrics(), trials);
  };
  CHECK(*table_of(mean).rows[0].cells[0].value == Approx(54.0));
  CHECK(*table_of(median).rows[0].cells[0].value == Approx(45.0));
  CHECK_THAT(latex_table(table_of(median)), Contains("means over 5 drawn tasks, medians of time."));
  CHECK_THAT(latex_table(table_of(mean)), Contains("means over 5 drawn tasks."));
}

TEST_CASE("rows by controller are over the tasks that every planner solves", "[export]") {
  std::vector<TrialRecord> trials;
  for (const char* planner : {"strong", "weak"})
    for (std::uint32_t i = 0; i < 4; ++i) {
      const bool planned = std::string(planner) == "strong" || i < 2;
      // the strong planner's robots do not arrive in the hard tasks either
      trials.push_back(ranking_trial(planner, "C", i, {i < 2 ? RobotResult{} : RobotResult{std::nullopt}}));
      if (!planned)
        for (MetricValue& value : trials.back().values)
          if (value.metric == "planned") value.value.reset();
    }
  const auto table_of = [&](std::vector<Label> rows) {
    return make_mean_table({"t", "Results", std::move(rows), {}, {{"done", "success", 2, "", false, ""}}},
                           ranking_layout(), ranking_metrics(), trials);
  };
  const MeanTable by_controller = table_of({Label::local_controller});
  REQUIRE(by_controller.rows.size() == 1);
  CHECK(by_controller.rows[0].cells[0].trials == 4);
  CHECK(*by_controller.rows[0].cells[0].value == Approx(1.0));
  CHECK_THAT(table_caption(by_controller), Contains("Over the tasks for which every planner has a plan."));

  // a combination without a plan counts 0
  const MeanTable combinations = table_of({Label::global_planner, Label::local_controller});
  REQUIRE(combinations.rows.size() == 2);
  CHECK(*combinations.rows[1].cells[0].value == Approx(0.5));
  CHECK_THAT(table_caption(combinations), !Contains("Over the tasks"));
  std::erase_if(trials, [](const TrialRecord& trial) { return trial.global_planner == "strong"; });
  CHECK(*table_of({Label::local_controller}).rows[0].cells[0].value == Approx(0.5));
}

TEST_CASE("names are escaped for LaTeX", "[export]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "50%_a&b{c}\\d~e", 2, [](std::uint32_t) { return std::vector<RobotResult>{{}}; });
  const MeanTable table =
      make_mean_table({"t", "A_B", {Label::local_controller}, {}, {{"done", "x_y", 1, "", false, ""}}},
                      ranking_layout(), ranking_metrics(), trials);
  const std::string latex = latex_table(table);
  CHECK_THAT(latex, Contains("50\\%\\_a\\&b\\{c\\}\\textbackslash{}d\\~{}e & 1.0"));
  CHECK_THAT(latex, Contains("\\caption{A\\_B"));
}

TEST_CASE("swept values of scenarios are columns", "[export]") {
  std::vector<TrialRecord> trials;
  for (const char* people : {"6", "12"})
    for (const char* tracking : {"none", "visible"}) {
      const std::size_t first = trials.size();
      add_trials(trials, "slow", 3, [](std::uint32_t) { return std::vector<RobotResult>{{}}; });
      for (std::size_t i = first; i < trials.size(); ++i) {
        trials[i].swept = {{"", "people", people}, {"simulation", "tracking", tracking}};
        trials[i].scenario = with_swept("mall", trials[i].swept);
      }
    }
  CHECK(trials.back().scenario == "mall (people 12, tracking visible)");
  const RunSettings settings(effective, trials);
  CHECK(settings.value("people", trials.front()) == "6");
  CHECK(settings.value("simulation.tracking", trials.back()) == "visible");
}

TEST_CASE("people are their number, which needs no sweep", "[export]") {
  std::vector<TrialRecord> trials;
  add_trials(trials, "slow", 3, [](std::uint32_t) { return std::vector<RobotResult>{{}}; });
  for (std::size_t i = 0; i < 3; ++i) trials.push_back(trials[i]);
  for (std::size_t i = 3; i < 6; ++i) trials[i].scenario = "office";
  ScenarioFacts mall;
  mall.name = "mall";
  mall.robots = 1;
  mall.people = 12;
  ScenarioFacts office = mall;
  office.name = "office";
  office.people = 1;
  const PeopleCounts people = people_counts(std::vector{mall, office});

  const RunSettings settings(effective, trials, people);
  CHECK(settings.value("people", trials.front()) == "12");
  CHECK(settings.value("people", trials.back()) == "1");

  CHECK(label_named("people") == Label::people);
  const TableSpec spec = {
      "t", "Results", {Label::pedestrian_model}, {Label::people}, {{"done", "done", 2, "", false, ""}}, people};
  MeanTable table = make_mean_table(spec, ranking_layout(), ranking_metrics(), trials);
  CHECK(table.spans == std::vector<std::string>{"12 people", "1 person"});
  CHECK(table.rows.front().name == "crowd");
  trials.back().pedestrian_model = "";
  table = make_mean_table(spec, ranking_layout(), ranking_metrics(), trials);
  CHECK(table.spans.back() == "0 people");
}

TEST_CASE("a LaTeX table that is wider than a page comes in parts of whole spans, then of metrics", "[export]") {
  SummaryTableColumn done{"done", "success", 2, "", false, ""};
  SummaryTableColumn time{"time", "time", 1, "", false, ""};
  const auto table_of = [&](const TableSpec& spec) {
    return make_mean_table(spec, ranking_layout(), ranking_metrics(), example());
  };
  const MeanTable narrow = table_of({"t", "Results", {Label::local_controller}, {Label::robots}, {done, time}});
  REQUIRE(latex_parts(narrow).size() == 1);
  CHECK(latex_table(latex_parts(narrow)[0]) == latex_table(narrow));

  done.header = std::string(40, 'd');
  const std::vector<MeanTable> by_span =
      latex_parts(table_of({"t", "Results", {Label::local_controller}, {Label::robots}, {done, time}}));
  REQUIRE(by_span.size() == 2);
  CHECK(by_span[0].spans == std::vector<std::string>{"2 robots"});
  CHECK(by_span[1].spans == std::vector<std::string>{"4 robots"});
  for (const MeanTable& part : by_span) CHECK(part.rows.size() == 2);
  CHECK(*by_span[0].rows[1].cells[1].value == Approx(20.0));
  CHECK(*by_span[1].rows[1].cells[0].value == Approx(0.75));
  CHECK_THAT(latex_table(by_span[0]), Contains("\\caption{Results, part 1 of 2: means"));
  CHECK_THAT(latex_table(by_span[0]), Contains("\\label{tab:t}"));
  CHECK_THAT(latex_table(by_span[1]), Contains("\\label{tab:t-2}"));
  CHECK_THAT(latex_table(by_span[1]), Contains("\\multicolumn{2}{c}{4 robots}"));

  time.header = std::string(90, 't');
  const std::vector<MeanTable> by_metric =
      latex_parts(table_of({"t", "Results", {Label::local_controller}, {Label::robots}, {done, time}}));
  REQUIRE(by_metric.size() == 4);  // two spans, each in two parts
  CHECK(by_metric[3].spans == std::vector<std::string>{"4 robots"});
  CHECK(by_metric[3].units == std::vector<std::string>{"s"});
  CHECK(by_metric[2].rows[1].cells.size() == 1);
  CHECK_THAT(latex_table(by_metric[3]), Contains("part 4 of 4"));
  CHECK(latex_parts(table_of({"t", "Results", {Label::local_controller}, {}, {done, time}})).size() == 2);
  CHECK(latex_parts(table_of({"t", "Results", {Label::local_controller}, {}, {}})).empty());
}

TEST_CASE("trials are chosen by what stands in their columns", "[export]") {
  std::vector<TrialRecord> trials = example();
  for (std::size_t i = 0; i < trials.size(); ++i) trials[i].id = i;
  const RunSettings settings(effective, trials);
  const auto count = [&](const std::vector<std::string>& conditions) {
    return trials_where(conditions, trials, settings).size();
  };
  CHECK(count({"robots=2"}) == 20);
  CHECK(count({"robots=2.0", "controller=slow"}) == 10);
  CHECK(count({"local_controller.speed=1.00"}) == 20);
  CHECK(count({"local_controller.mode=a, b", "trial=7", "trial=8"}) == 2);
  CHECK(count({"local_controller=slow", "local_controller=fast"}) == 30);
  const auto refusal = [&](const std::vector<std::string>& conditions) -> std::string {
    try {
      trials_where(conditions, trials, settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal({"speed=1"}), Contains("--where speed=1: 'speed' is none of the ") &&
                                       Contains(" columns of this run (did you mean 'local_controller.speed'?)"));
  CHECK_THAT(refusal({"local_controller=slwo"}), Contains("'slwo' is none of slow, fast (did you mean 'slow'?)"));
  CHECK_THAT(refusal({"trial=99"}), Contains("'99' is none of the 30 values of this run"));
  CHECK_THAT(refusal({"robots"}), Contains("'robots' is not KEY=VALUE"));
  CHECK_THAT(refusal({"robots=4", "local_controller=slow"}),
             Contains("--where robots=4 local_controller=slow: no trial has all of these"));
}

TEST_CASE("a table as a figure has the values of the LaTeX table", "[export]") {
  SummaryTableColumn done{"done", "success", 2, "", false, ""};
  SummaryTableColumn time{"time", "time", 1, "", false, ""};
  const MeanTable table = make_mean_table({"t", "A < B", {Label::local_controller}, {Label::robots}, {done, time}},
                                          ranking_layout(), ranking_metrics(), example());
  const std::string svg = table_figure(table);
  CHECK_THAT(svg, Contains(">2 robots</text>"));
  CHECK_THAT(svg, Contains(">slow</text>"));
  CHECK_THAT(svg, Contains(">47.0 (5/10)</text>"));
  CHECK_THAT(svg, Contains(">\u2013</text>"));  // no trials with four robots
  CHECK_THAT(svg, Contains(">A &lt; B: means over 10 drawn tasks."));
  CHECK(count_of(svg, "class=\"unit\">s</text>") == 2);
  CHECK(count_of(svg, "<path class=\"rule \"") == 2);
}

}  // namespace export_test
