// SPDX-License-Identifier: MIT
#include "host/compare/comparison_data.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/unit/host/ranking/ranking_example.hpp"

namespace comparison_data_test {

using namespace dmrp::host;
using namespace dmrp::test;

TEST_CASE("the data of a comparison's page have both runs and the differences", "[compare]") {
  ComparedRuns runs;
  runs.before.path = "runs/a";
  runs.before.run.metrics = ranking_metrics();
  ComparedRuns::Other other;
  other.run.path = "runs/b";
  MetricComparison done;
  done.metric = "done";
  done.pairs = 10;
  done.before = 0.5;
  done.after = 0.75;
  done.difference.over_tasks = {5, 0.25, 0.1, {0.125, 0.375}};
  MetricComparison none;
  none.metric = "time";
  other.comparison.pairs = 10;
  other.comparison.metrics = {done, none};
  other.comparison.libraries = {{"libone.so", "", "22"}};
  other.comparison.combinations = {{{"mall", 2, "P", "c", "crowd"}, {done, none}}};
  runs.others.push_back(other);

  const ReportLayouts layouts = {ranking_layout(), "{}", parse_report_layout("{}", "report")};
  const auto json = nlohmann::json::parse(comparison_data_json(runs, layouts));
  CHECK(json["before"]["path"] == "runs/a");
  CHECK(json["metrics"][2]["name"] == "done");
  const auto& run = json["runs"][0];
  CHECK(run["path"] == "runs/b");
  CHECK(run["differences"][0]["n"] == 5);
  CHECK(run["differences"][0]["difference"] == 0.25);
  CHECK(run["differences"][0]["low"] == 0.125);
  CHECK(run["differences"][0]["p"].is_null());
  CHECK_FALSE(run["differences"][1].contains("difference"));
  CHECK(run["libraries"][0]["before"].is_null());
  CHECK(run["libraries"][0]["after"] == "22");
  CHECK(run["combinations"][0]["local_controller"] == "c");
  CHECK(run["of_combinations"][0][0]["after"] == 0.75);
}

}  // namespace comparison_data_test
