// SPDX-License-Identifier: MIT
#include "host/results/csv.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "host/results/trials_csv.hpp"
#include "tests/unit/host/results/results_example.hpp"

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
        "sim_time_s,wall_time_s,done,time,speed,speed_sd,touches,cpu\n"
        "1,mall,2,\"A, B\",DWA,crowd,0,1000,failed,1,180,0.125,0.5,,0.30000000000000004,0.17,0,\n"
        "4,mall,2,C,DWA,crowd,1,1001,succeeded,1,41.5,0.125,1,41.5,0.5,0.17,0,\n");
}
