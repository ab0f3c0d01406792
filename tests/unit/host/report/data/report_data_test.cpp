// SPDX-License-Identifier: MIT
// What a report says of constructed trials: the numbers of summary.csv, hand-computed comparisons, and the special cases
// that a run may end in.
#include "host/report/data/report_data.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/findings/summary.hpp"
#include "host/results/csv.hpp"
#include "tests/unit/host/ranking/ranking_example.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace report_data_test {

using namespace dmrp::host;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;
using dmrp::test::system_number;
using nlohmann::json;

const std::vector<std::string> failure_metrics{"done"};

ReportLayouts example_layouts() {
  const std::string summary = R"({"columns": [{"metric": "time"}], "arrived": "done", "counts_failures": ["done"],
                                "answer": {"people_progress": "progress", "people_speed": "desired"}})";
  return {parse_summary_layout(summary, "summary"), summary,
          parse_report_layout(R"({
            "diagnosis": {"x": "speed", "y": ["time", "done", "not measured"]},
            "comparisons": [{"metric": "time", "test": "signed_rank", "censored": true},
                            {"metric": "done", "test": "mean"}, {"metric": "not measured"}],
            "completion": {"metric": "time"},
            "curves": [{"metric": "curve", "coordinate": "distance", "coordinate_unit": "m"}]
          })",
                              "report")};
}

ReportRun example_run(std::vector<TrialRecord> trials) {
  ReportRun run;
  run.manifest.dmrp_version = "0.1.0";
  run.manifest.experiment = {"example", 18446744073709551615u, 3, {}, 6, {{"mall", "Mall", "of shops", 2, 12, 180.0}}};
  run.manifest_json = R"({"dmrp_version": "0.1.0"})";
  run.effective_toml = "[experiment]\n";
  run.metrics = example_metrics();
  run.trials = std::move(trials);
  return run;
}

json data_of(const ReportRun& run) {
  return json::parse(report_data_json(run, example_layouts(), {}));
}

json data_of(std::vector<TrialRecord> trials, const std::vector<std::string>& robot_types = {}) {
  ReportRun run = example_run(std::move(trials));
  for (ScenarioFacts& scenario : run.manifest.experiment.scenarios) scenario.robot_types = robot_types;
  return data_of(run);
}

// `planners` with as many repetitions as there are times for each; none: it failed. The robots arrive with the trial.
std::vector<TrialRecord> trials_of(const std::map<std::string, std::vector<std::optional<double>>>& times) {
  std::vector<TrialRecord> trials;
  for (const auto& [planner, of_planner] : times)
    for (std::uint32_t repetition = 0; repetition < of_planner.size(); ++repetition) {
      const std::optional<double>& time = of_planner[repetition];
      TrialRecord trial = example_trial(trials.size(), planner, repetition, time, 0.5 + 0.01 * repetition);
      for (const std::uint64_t robot : {0, 1})
        trial.values.push_back({"time", DMRP_SUBJECT_ROBOT, robot, std::nullopt, time});
      trials.push_back(std::move(trial));
    }
  return trials;
}

TrialRecord fault_of(TrialRecord trial) {
  trial.outcome = trial_outcome::fault;
  trial.values.clear();
  trial.faults.push_back({"crash", "org.x", "step", 7, 1, 11, "segmentation fault", "dmrp-host run x.toml"});
  return trial;
}

// The text that summary.csv has for a number of the data.
std::string csv_text(const json& number) {
  return number.is_null() ? "" : shortest_number(number.get<double>());
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line + ",");
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

const json& comparison(const json& data, const std::string& metric, const std::string& varied = "global_planner") {
  for (const json& one : data["comparisons"])
    if (one["metric"] == metric && one["varied"] == varied) return one;
  throw std::runtime_error("no comparison of " + metric);
}

TEST_CASE("a report's summaries are the numbers of summary.csv", "[report]") {
  std::vector<TrialRecord> trials = trials_of({{"A", {40.0, 43.25, std::nullopt, 41.0, 47.0}}, {"B", {50.1, 49.3}}});
  trials[1].values[4].value = std::nullopt;  // the speed of one trial is undefined
  trials.push_back(fault_of(example_trial(7, "B", 2, 50.0, 0.5)));
  const json data = data_of(trials);
  const auto metrics = example_metrics();
  std::istringstream csv(summary_csv(metrics, summarise(metrics, trials, {failure_metrics})));
  std::string line;
  std::getline(csv, line);
  for (const json& of_combination : data["summaries"])
    for (const json& summary : of_combination) {
      REQUIRE(std::getline(csv, line));
      const std::vector<std::string> fields = fields_of(line);  // n is the tenth
      CHECK(summary["n"] == std::stoi(fields[9]));
      CHECK(summary["trials"] == std::stoi(fields[19]));
      CHECK(summary["defined"] == std::stoi(fields[10]));
      std::size_t column = 11;
      for (const char* key : {"mean", "sd", "median", "low", "high", "paper_mean"})
        CHECK(csv_text(summary[key]) == fields[column++]);
      CHECK(summary["paper_count"] == std::stoi(fields[17]));
    }
  CHECK_FALSE(std::getline(csv, line));
  CHECK(data["values"]["speed"][1].is_null());
  CHECK(data["values"]["time"][0] == 40.0);
  CHECK(data["values"]["cpu"][0].is_null());
}

TEST_CASE("a report counts arrivals by type of robot where there are several", "[report]") {
  CHECK(data_of(trials_of({{"A", {40.0, 43.0}}}))["arrivals_by_type"].empty());
  const json rows = data_of(trials_of({{"A", {40.0, 43.0}}, {"B", {50.0}}}), {"default", "tug"})["arrivals_by_type"];
  REQUIRE(rows.size() == 2);
  CHECK(rows[0]["combination"]["global_planner"] == "A");
  CHECK(rows[0]["types"] == json::parse(R"([{"type": "default", "robots": 2, "arrived": 2},
                                            {"type": "tug", "robots": 2, "arrived": 2}])"));
  CHECK(rows[1]["types"][1]["robots"] == 1);
}

TEST_CASE("a report has the places between two bounds", "[report]") {
  ReportRun run = example_run({});
  run.metrics = dmrp::test::ranking_metrics();
  const auto add = [&](const std::string& controller, double time_s) {
    dmrp::test::add_trials(run.trials, controller, 20, [=](std::uint32_t i) {
      return std::vector<dmrp::test::RobotResult>(2, {time_s + 0.1 * i, controller == "high"});
    });
  };
  add("low", 40.0);
  add("middle", 35.0);
  add("high", 20.0);
  const ReportLayouts layouts = {dmrp::test::ranking_layout(), "{}", parse_report_layout("{\"tables\": []}", "report")};
  const auto with = [&](const std::string& toml) {
    run.effective_toml = toml;
    return json::parse(report_data_json(run, layouts, {}));
  };
  const json data = with(
      "[[local_controller]]\nlabel = \"low\"\nbound = \"lower\"\n"
      "[[local_controller]]\nlabel = \"high\"\nbound = \"upper\"\n");
  const json table = data["layouts"]["report"]["tables"].back();
  CHECK(table["id"] == "places");
  REQUIRE(table["columns"].size() == 2);
  CHECK(table["columns"][1]["metric"] == "place_time");
  CHECK(data["metrics"].back()["name"] == "place_time");
  CHECK(data["summaries"][1].back()["mean"].get<double>() == Approx(0.25));
  CHECK(data["summaries"][0].back()["mean"].is_null());
  CHECK(with("")["layouts"]["report"]["tables"].empty());
}

TEST_CASE("a report describes the run", "[report]") {
  const json data = data_of(trials_of({{"A", {40.0, 43.0}}, {"B", {50.0}}}));
  CHECK(data["format"] == 1);
  CHECK(data["run"]["name"] == "example");
  CHECK(data["run"]["seed"] == "18446744073709551615");  // all its digits
  CHECK(data["run"]["trials_planned"] == 6);
  CHECK(data["run"]["trials_finished"] == 3);  // interrupted
  CHECK(data["scenarios"][0]["people"] == 12);
  CHECK(data["trials"]["combination"] == json({0, 0, 1}));
  CHECK(data["trials"]["seed"] == json({"1000", "1001", "1000"}));
  CHECK(data["planners"].size() == 2);
  CHECK(data["planner_summaries"][0] == data["summaries"][0]);  // one controller
  CHECK(data["metrics"][1]["direction"] == "lower");
  CHECK(data["layouts"]["report"]["completion"]["metric"] == "time");
}

TEST_CASE("values of trials have seven significant digits", "[report]") {
  const auto written = [](double time) {
    return data_of({example_trial(0, "P", 0, time, 0.5)})["values"]["time"].dump();
  };
  CHECK(written(100.0 / 3.0) == "[33.33333]");
  CHECK(written(-2e-3 / 3.0) == "[-0.0006666667]");
  CHECK(written(12345678.25) == "[12345678.25]");
  CHECK(written(40.0) == "[40.0]");
}

TEST_CASE("a report lists faults and counts skipped trials", "[report]") {
  std::vector<TrialRecord> trials = trials_of({{"A", {40.0}}});
  trials.push_back(fault_of(example_trial(1, "A", 1, 50.0, 0.5)));
  trials.push_back(example_trial(2, "C", 0, 50.0, 0.5));
  trials.back().outcome = trial_outcome::skipped;
  trials.back().values.clear();
  trials[1].faults[0].detail = "\xff not UTF-8";
  trials[1].timing = {{"org.example.x", "reads a clock"}};
  const json data = data_of(trials);
  REQUIRE(data["timing"].size() == 1);
  CHECK(data["timing"][0] == json{{"trial", 1}, {"plugin", "org.example.x"}, {"reason", "reads a clock"}});
  REQUIRE(data["faults"].size() == 1);
  CHECK(data["faults"][0]["trial"] == 1);
  CHECK(data["faults"][0]["robot"] == 1);
  CHECK(data["faults"][0]["rerun"] == "dmrp-host run x.toml");
  CHECK(data["run"]["trials_finished"] == 2);
  REQUIRE(data["combinations"].size() == 2);
  CHECK(data["summaries"][1][0].is_null());  // nothing ran
  CHECK(data["completion"].size() == 1);
  CHECK(data["completion"][0]["robots"] == 4);
  CHECK(data["completion"][0]["arrived_share"] == 0.5);
  CHECK(data["completion"][0]["restricted_mean_s"] == Approx((40.0 + 40.0 + 180.0 + 180.0) / 4.0));
}

TEST_CASE("one trial, or one in which all robots fail, makes a report", "[report]") {
  const std::optional<double> time = GENERATE(std::optional<double>(), std::optional<double>(41.0));
  const json data = data_of(trials_of({{"A", {time}}}));
  CHECK(data["comparisons"].empty());
  CHECK(data["summaries"][0][1]["defined"] == (time ? 1 : 0));
  CHECK(data["summaries"][0][1]["mean"].is_null() == !time);
  CHECK(data["summaries"][0][1]["low"].is_null());
  CHECK(data["completion"][0]["restricted_mean_s"] == time.value_or(180.0));
  CHECK(data["completion"][0]["arrived_share"] == (time ? 1.0 : 0.0));
  CHECK(data["completion"][0]["steps"].size() == (time ? 1u : 0u));
  REQUIRE(data["correlations"].size() == 2);
  CHECK(data["correlations"][0]["rho"].is_null());
}

TEST_CASE("trials are compared by task", "[report]") {
  SECTION("Hollander and Wolfe's nine patients as tasks") {
    const json data = data_of(trials_of({{"A", {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30}},
                                         {"B", {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29}}}));
    const json& time = comparison(data, "time");
    CHECK(time["a"] == "A");
    CHECK(time["b"] == "B");
    CHECK(time["given"] == json({{"local_controller", "DWA"}, {"pedestrian_model", "crowd"}}));
    CHECK(time["pairs"] == 9);
    CHECK(time["test"] == "signed_rank");
    CHECK(time["p"] == Approx(20.0 / 512.0));
    CHECK(time["p_holm"] == time["p"]);  // alone in its family
    CHECK(time["median_difference"] == Approx(-0.46));
    CHECK(time["low"] == Approx(-0.786));
    CHECK(time["high"] == Approx(-0.010));
    CHECK(time["effect"] == Approx(-35.0 / 45.0));
    const json& done = comparison(data, "done");
    CHECK(done["equal"] == true);
    CHECK(done["p"].is_null());
    CHECK(done["ties"] == 9);
    CHECK(data["comparisons"].size() == 2);
  }
  SECTION("who never arrives counts with the time limit, and a seed that one of them lacks is no pair") {
    const json data = data_of(trials_of({{"A", {40.0, 50.0, 60.0}}, {"B", {std::nullopt, 50.0}}}));
    const json& time = comparison(data, "time");
    CHECK(time["pairs"] == 2);
    CHECK(time["ties"] == 1);
    CHECK(time["mean_difference"] == 70.0);  // (180 - 40 + 0) / 2
    CHECK(comparison(data, "done")["mean_difference"] == -0.25);
  }
  SECTION("a fault is a failure where that counts") {
    std::vector<TrialRecord> trials = trials_of({{"A", {40.0}}});
    trials.push_back(fault_of(example_trial(1, "B", 0, 50.0, 0.5)));
    const json data = data_of(trials);
    CHECK(comparison(data, "done")["mean_difference"] == -1.0);
    CHECK(comparison(data, "time")["mean_difference"] == 140.0);
  }
  SECTION("what means something of successes only is compared where both succeeded") {
    ReportLayouts layouts = example_layouts();
    layouts.report.comparisons = {{"speed", PairedTest::signed_rank, false, true}};
    const auto compared = [&](const std::vector<TrialRecord>& trials) {
      return json::parse(report_data_json(example_run(trials), layouts, {}))["comparisons"];
    };
    const json found = compared(trials_of({{"A", {40.0, std::nullopt, 60.0}}, {"B", {50.0, 50.0, std::nullopt}}}));
    REQUIRE(found.size() == 1);
    CHECK(found[0]["pairs"] == 1);
    CHECK(compared(trials_of({{"A", {40.0, std::nullopt}}, {"B", {std::nullopt, 50.0}}})).empty());
  }
  SECTION("the crowds of one task are one observation, and few tasks give no p") {
    std::vector<TrialRecord> trials = trials_of({{"A", {10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0}},
                                                 {"B", {12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 21.0}}});
    for (TrialRecord& trial : trials) trial.task = std::to_string(trial.repetition % 4);
    const json data = data_of(trials);
    const json& time = comparison(data, "time");
    CHECK(time["pairs"] == 8);
    CHECK(time["n"] == 4);
    CHECK(time["mean_difference"] == 2.25);
    CHECK(time["p"].is_null());
    CHECK(data["summaries"][0][1]["n"] == 4);
  }
  SECTION("Holm's correction runs over the planners of one scenario") {
    const json data = data_of(trials_of({{"A", {10.0, 10.0, 10.0, 10.0, 10.0}},
                                         {"B", {11.0, 12.0, 13.0, 14.0, 15.0}},
                                         {"C", {12.0, 14.0, 16.0, 18.0, 20.0}}}));
    std::vector<double> p;
    std::vector<double> p_holm;
    for (const json& one : data["comparisons"]) {
      if (one["metric"] != "time") continue;
      p.push_back(one["p"]);
      p_holm.push_back(one["p_holm"]);
    }
    CHECK(p == std::vector<double>(3, 0.0625));  // 2 / 2^5
    CHECK(p_holm == std::vector<double>(3, 0.1875));
  }
}

TEST_CASE("correlations stay within a scenario and planner", "[report]") {
  // within A and within B faster is sooner; over both it would be the reverse
  std::vector<TrialRecord> trials =
      trials_of({{"A", {40.0, 39.0, 38.0, 37.0, 36.0, 35.0}}, {"B", {90.0, 89.0, 88.0, 87.0, 86.0, 85.0}}});
  for (std::size_t i = 6; i < 12; ++i) trials[i].values[4].value = 2.0 + static_cast<double>(i);
  const json data = data_of(trials);
  REQUIRE(data["correlations"].size() == 4);
  for (const json& one : data["correlations"])
    if (one["y"] == "time") {
      CHECK(one["rho"] == Approx(-1.0));
      CHECK(one["n"] == 6);
      CHECK(one["p"].get<double>() < 0.01);  // 2 of 720
      CHECK(one["ties_share"] == 0.0);
    } else {
      CHECK(one["rho"].is_null());  // all succeeded
    }
  SECTION("five tasks have none, however many crowds they meet") {
    for (TrialRecord& trial : trials) trial.task = std::to_string(trial.repetition % 5);
    for (const json& one : data_of(trials)["correlations"]) CHECK(one["rho"].is_null());
  }
}

TEST_CASE("a correlation does not count differences between controllers", "[report]") {
  std::vector<TrialRecord> trials = trials_of({{"A", {40.0, 41.0, 42.0, 43.0, 44.0, 45.0}}});
  const std::size_t of_one = trials.size();
  for (std::size_t i = 0; i < of_one; ++i) {  // the second controller is fast and late, each is neither
    trials[i].values[4].value = 1.0 - 0.01 * static_cast<double>(i);
    TrialRecord& other = trials.emplace_back(trials[i]);
    other.local_controller = "other";
    other.values[3].value = *other.values[3].value + 20.0;
    other.values[4].value = *other.values[4].value + 1.0;
  }
  const json data = data_of(trials);
  REQUIRE(data["correlations"].size() == 2);
  CHECK(data["correlations"][0]["y"] == "time");
  CHECK(data["correlations"][0]["n"] == 6);
  CHECK(data["correlations"][0]["rho"] == Approx(-1.0));
}

TEST_CASE("curves have a point for each threshold", "[report]") {
  std::vector<TrialRecord> trials = trials_of({{"A", {40.0, 41.0}}});
  for (const double threshold : {1.0, 0.5})
    for (std::size_t i = 0; i < 2; ++i)
      trials[i].values.push_back({"curve", DMRP_SUBJECT_SYSTEM, std::nullopt, threshold,
                                  threshold < 1.0 && i == 1 ? std::nullopt : std::optional(threshold * 10.0)});
  ReportRun run = example_run(trials);
  run.metrics.push_back({"curve", "%", DMRP_DIRECTION_LOWER, false, "over thresholds"});
  const json data = data_of(run);
  REQUIRE(data["curves"].size() == 1);
  const json& curve = data["curves"][0];
  CHECK(curve["coordinate_unit"] == "m");
  CHECK(curve["points"] == json::parse("[[0.5, 5.0, null, null, 1], [1.0, 10.0, null, null, 2]]"));
  CHECK_FALSE(data["values"].contains("curve"));
}

TEST_CASE("the delay of people is the progress lost against the same crowd without robots", "[report]") {
  std::vector<TrialRecord> trials;
  const auto add = [&](std::uint32_t robots, std::uint32_t repetition, double speed, int seconds) {
    TrialRecord trial = example_trial(trials.size(), robots == 0 ? "" : "A", repetition, 40.0, 0.5);
    trial.robots = robots;
    if (robots == 0) trial.local_controller.clear();
    trial.values = {system_number("desired", 1.25)};
    for (int t = 0; t <= seconds; ++t)
      trial.values.push_back({"progress", DMRP_SUBJECT_SYSTEM, std::nullopt, t, speed * t});
    trials.push_back(trial);
  };
  add(0, 0, 1.25, 60);
  add(0, 1, 1.25, 30);  // everybody had left
  add(2, 0, 1.0, 40);   // 10 m lost in 40 s: 8 s
  add(2, 1, 1.0, 40);   // 7.5 m in the 30 s that both have: 6 s
  add(2, 2, 1.0, 40);   // no partner
  ReportRun run = example_run(trials);
  run.metrics.push_back({"progress", "m", DMRP_DIRECTION_HIGHER, false, ""});
  run.metrics.push_back({"desired", "m/s", DMRP_DIRECTION_NONE, false, ""});
  const json data = data_of(run);
  REQUIRE(data["pedestrian_delay"].size() == 1);
  const json& delay = data["pedestrian_delay"][0];
  CHECK(delay["combination"] == 1);
  CHECK(delay["pairs"] == 2);
  CHECK(delay["mean_s"] == Approx(7.0));
  CHECK(delay["n"] == 2);
  CHECK(delay["low"].is_null());  // below ten tasks there is no interval
  CHECK(data["curves"].empty());  // what delays are made of is no threshold curve
  CHECK(data["completion"].empty());
}

TEST_CASE("layouts of reports are checked", "[report]") {
  CHECK_THROWS_WITH(parse_report_layout("{\"tabels\": []}", "a.json"), "a.json: unknown key 'tabels'");
  CHECK_THROWS_WITH(parse_report_layout("{\"comparisons\": [{\"test\": \"mean\"}]}", "a.json"),
                    "a.json: a comparison without 'metric'");
  CHECK_THROWS_WITH(parse_report_layout("{\"comparisons\": [{\"metric\": \"x\", \"test\": \"t\"}]}", "a.json"),
                    "a.json: 'test' must be \"signed_rank\" or \"mean\"");
  CHECK_THROWS_WITH(
      parse_report_layout("{\"comparisons\": [{\"metric\": \"x\", \"censored\": true, \"both_succeeded\": true}]}",
                          "a.json"),
      "a.json: a comparison cannot be both 'censored' and 'both_succeeded'");
  const ReportLayout shipped = read_report_layout(DMRP_REPORT_LAYOUT);
  CHECK(shipped.comparisons.size() >= 3);
  CHECK(shipped.diagnosis.y.size() == 4);
}

}  // namespace report_data_test
