// SPDX-License-Identifier: MIT
#include "host/results/csv.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "host/findings/summary.hpp"
#include "host/results/trials_csv.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace csv_test {

using namespace dmrp::host;
using dmrp::test::example_metrics;
using dmrp::test::example_trial;

TEST_CASE("CSV fields are quoted where they must be", "[results]") {
  CsvWriter csv;
  csv.field("plain").field("a,b").field("say \"hi\"").field("two\nlines").field("").field(std::optional<double>());
  csv.end_line();
  csv.field(0.1).field(1e300).field(-0.0).field(100.0).field(std::numeric_limits<double>::quiet_NaN()).field(7);
  csv.end_line();
  CHECK(csv.text() == "plain,\"a,b\",\"say \"\"hi\"\"\",\"two\nlines\",,\n0.1,1e+300,-0,100,,7\n");
}

TEST_CASE("trials.csv has a line for each trial and a column for each metric", "[results]") {
  TrialRecord curved = example_trial(1, "A, B", 0, std::nullopt, 0.1 + 0.2);
  curved.values.insert(curved.values.begin(), {"time", DMRP_SUBJECT_SYSTEM, std::nullopt, 3.0, 99.0});
  const std::vector<TrialRecord> trials{curved, example_trial(4, "C", 1, 41.5, 0.5)};
  CHECK(trials_csv(example_metrics(), trials) ==
        "trial,scenario,robots,global_planner,local_controller,pedestrian_model,repetition,seed,outcome,repeatable,"
        "sim_time_s,wall_time_s,task,task_is_drawn,done,time,speed,speed_sd,touches,cpu\n"
        "1,mall,2,\"A, B\",DWA,crowd,0,1000,failed,1,180,0.125,task 0,1,0.5,,0.30000000000000004,0.17,0,\n"
        "4,mall,2,C,DWA,crowd,1,1001,succeeded,1,41.5,0.125,task 1,1,1,41.5,0.5,0.17,0,\n");
}

TEST_CASE("each swept key is a column of trials.csv and summary.csv", "[results]") {
  std::vector<TrialRecord> trials{example_trial(1, "A", 0, 41.5, 0.5), example_trial(2, "B", 0, 41.5, 0.5)};
  trials[0].swept = {{"", "people", "6"}, {"simulation", "tracking", "none"}};
  trials[1].swept = {{"", "people", "12"}, {"global_planner", "weight", "1.5"}};
  const std::string csv = trials_csv(example_metrics(), trials);
  CHECK_THAT(csv,
             Catch::Contains(",wall_time_s,task,task_is_drawn,people,simulation.tracking,global_planner.weight,done,"));
  CHECK_THAT(csv, Catch::Contains(",0.125,task 0,1,6,none,,1,41.5,"));
  CHECK_THAT(csv, Catch::Contains(",0.125,task 0,1,12,,1.5,1,41.5,"));
  const std::string summary = summary_csv(example_metrics(), summarise(example_metrics(), trials, {}));
  CHECK_THAT(summary, Catch::Contains(",pedestrian_model,people,simulation.tracking,global_planner.weight,metric,"));
  CHECK_THAT(summary, Catch::Contains("mall,2,B,DWA,crowd,12,,1.5,done,"));
}

}  // namespace csv_test
