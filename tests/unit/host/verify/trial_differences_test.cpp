// SPDX-License-Identifier: MIT
#include "host/verify/trial_differences.hpp"

#include <catch2/catch.hpp>

namespace trial_differences_test {

using namespace dmrp::host;

const std::vector<MetricColumn> metrics = {{"success", "1", 0, false, "", false},
                                           {"planning_time", "s", 0, true, "", false}};

TrialRecord example() {
  TrialRecord trial;
  trial.id = 7;
  trial.outcome = trial_outcome::succeeded;
  trial.sim_time_s = 12.5;
  trial.values = {{"success", DMRP_SUBJECT_SYSTEM, {}, {}, 1.0},
                  {"success", DMRP_SUBJECT_ROBOT, 2, {}, 1.0},
                  {"success", DMRP_SUBJECT_SYSTEM, {}, 0.5, std::nullopt},
                  {"planning_time", DMRP_SUBJECT_SYSTEM, {}, {}, 0.25}};
  trial.events = {{"contacts", 1'000, 2'000, {0, 1}, {}, "touch", DMRP_SEVERITY_INFO, std::nullopt}};
  return trial;
}

std::vector<std::string> found(const TrialRecord& now) {
  return trial_differences(example(), now, metrics);
}

TEST_CASE("equal trials have no difference, whatever the clock said") {
  TrialRecord now = example();
  CHECK(found(now).empty());
  now.wall_time_s = 3.0;
  now.values[3].value = 0.5;
  std::swap(now.values[0], now.values[2]);
  CHECK(found(now).empty());
}

TEST_CASE("each difference of a trial is one line") {
  TrialRecord now = example();
  SECTION("its end") {
    now.outcome = trial_outcome::failed;
    now.sim_time_s = 12.520000000000001;
    CHECK(found(now) == std::vector<std::string>{"the outcome is failed, was succeeded",
                                                 "the simulated time in s is 12.520000000000001, was 12.5"});
  }
  SECTION("values: the last bit, an undefined one, one that is missing or new") {
    now.values[0].value = 0.9999999999999999;
    now.values[2].value = 0.0;
    now.values[1].subject = 3;
    CHECK(found(now) ==
          std::vector<std::string>{"success is 0.9999999999999999, was 1", "success at 0.5 is 0, was undefined",
                                   "success of robot 2 is missing, was 1", "success of robot 3 is 1, was missing"});
  }
  SECTION("events and faults") {
    now.events[0].to_ns = 2'001;
    now.faults.push_back({"crash", "org.example.mine", "step", 3, 0, 11, "Segmentation fault", ""});
    const std::string event = "event of contacts from 1000 to ";
    CHECK(found(now) == std::vector<std::string>{event + "2000 ns: touch (severity 0, robots 0 1, people ) is missing",
                                                 event + "2001 ns: touch (severity 0, robots 0 1, people ) is new",
                                                 "fault crash in org.example.mine step(): Segmentation fault is new"});
  }
}

}  // namespace trial_differences_test
