// SPDX-License-Identifier: MIT
// The plans that trials share, as files that other programs read.
#include "host/workers/stored_plan.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "host/errors/input_error.hpp"
#include "tests/unit/host/results/results_example.hpp"

namespace stored_plan_test {

using namespace dmrp::host;
using Catch::Matchers::Contains;

const PlannedPaths example = {
    {{0.5, -0.0, dmrp::core::free_heading, 0, 0, 0}, {1.0 / 3.0, 5e-324, 3.25, 1'800'000'000, 1, 0}},
    {{1e22, 0.1 + 0.2, -1.5, 9'000'000'000'000'000'001, 0, 0}}};

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

TEST_CASE("a plan as CSV keeps its bits") {
  const dmrp::test::ScratchFolder folder;
  write(folder / "plan.csv", plan_csv(example));
  CHECK(dmrp::test::content_of(folder / "plan.csv").starts_with("robot,t_ns,x,y,theta,goal_index\n0,0,0.5,-0,,0\n"));
  const PlannedPaths read = read_plan_csv(folder / "plan.csv");
  PlannerAnswer before;
  before.paths = example;
  PlannerAnswer after = before;
  after.paths = read;
  CHECK(same_plan(before, after));
  CHECK(std::signbit(read[0][0].y));
  after.paths[1][0].x = 1.0;
  CHECK_FALSE(same_plan(before, after));

  write(folder / "none.csv", plan_csv({}));
  CHECK(read_plan_csv(folder / "none.csv").empty());
}

TEST_CASE("a mistake in a plan is named by line and column") {
  const dmrp::test::ScratchFolder folder;
  const auto mistake = [&](const std::string& text) {
    write(folder / "plan.csv", text);
    try {
      read_plan_csv(folder / "plan.csv");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no mistake");
  };
  const std::string header = "robot,t_ns,x,y,theta,goal_index\n";
  CHECK_THAT(mistake("agent,t,x,y\n"),
             Contains("plan.csv:1:1: the first line must be 'robot,t_ns,x,y,theta,goal_index'"));
  CHECK_THAT(mistake("task," + header), Contains("plan.csv:1:1: the first line must be 'robot,"));
  CHECK_THAT(mistake(header + "0,0,1,2,,0\n0,late,1,2,,0\n"),
             Contains(":3:3: t_ns must be a whole number, not 'late'"));
  CHECK_THAT(mistake(header + "1,0,1,2,,0\n"), Contains(":2:1: robot must be 0"));
  CHECK_THAT(mistake(header + "0,0,1,2,north,0\n"), Contains(":2:9: theta must be a number, not 'north'"));
  CHECK_THAT(mistake(header + "0,0,1,2\n"), Contains(":2:"));
  CHECK_THAT(mistake(header + "0,0,1,2,,0,7\n"), Contains("a row has the values robot,t_ns,x,y,theta,goal_index"));
}

TEST_CASE("a stored plan keeps the planner's call and statistics, or its fault") {
  const dmrp::test::ScratchFolder folder;
  const StoredPlans plans(folder / "run");
  CHECK(plans.names().empty());
  StoredPlan made;
  made.answer = {DMRP_TIMEOUT,
                 12,
                 34,
                 "because",
                 example,
                 {},
                 {{"cost", 0.1}, {"bound", std::numeric_limits<double>::infinity()}}};
  made.timing = {{"org.x", "plan() was stopped by its time budget"}};
  std::filesystem::create_directories(plans.csv_file("one").parent_path());
  write(plans.csv_file("one"), plan_csv(example));
  plans.write_call("one", made);
  const StoredPlan read = plans.read("one");
  CHECK(same_plan(read.answer, made.answer));
  CHECK(read.answer.planning_ns == 12);
  CHECK(read.answer.text == "because");
  CHECK(read.answer.processor_ns == 34);
  REQUIRE(read.answer.statistics.size() == 2);
  CHECK(read.answer.statistics[0].value == 0.1);
  CHECK(std::isinf(read.answer.statistics[1].value));
  CHECK(read.timing == made.timing);
  CHECK(read.paths_sha256.size() == 64);

  plans.write_call("two", {{}, {}, FaultRecord{"crash", "org.x", "plan", 0, -1, 11, "", ""}, "abc"});
  CHECK(plans.read("two").fault->kind == "crash");
  CHECK(plans.read("two").task == "abc");
  CHECK(plans.names() == std::vector<std::string>{"one", "two"});
  CHECK(outcome_of(plans.read_call("one")) != outcome_of(plans.read_call("two")));

  const StoredPlans copied(folder / "other");
  for (const char* const name : {"one", "two", "none"}) copied.copy(plans, name);
  CHECK(copied.names() == plans.names());
  CHECK(same_plan(copied.read("one").answer, made.answer));
  copied.delete_faults();
  CHECK(copied.names() == std::vector<std::string>{"one"});
  write(folder / "run" / "plans" / "one.json", "{}");
  CHECK_THROWS_AS(plans.read_call("one"), InputError);
}

TEST_CASE("trials share a plan by scenario, planner and repetition") {
  CHECK(plan_name({0, 1, 0, -1}, 3) == plan_name({0, 1, 2, 4}, 3));
  CHECK(plan_name({0, 1, 0, -1}, 3) != plan_name({1, 1, 0, -1}, 3));
  CHECK(plan_name({0, 1, 0, -1}, 3) != plan_name({0, 0, 0, -1}, 3));
  CHECK(plan_name({0, 1, 0, -1}, 3) != plan_name({0, 1, 0, -1}, 2));
  CHECK(plan_name({0, -1, -1, 0}, 3).empty());
}

}  // namespace stored_plan_test
