// SPDX-License-Identifier: MIT
// Trials in which a plugin uses the contract in a rare way, or breaks it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/host/plugins/odd_library.hpp"

namespace odd_trials_test {

using namespace dmrp::host;
using namespace dmrp::test;

const std::string planner = "test.odd.planner", controller = "test.odd.controller", central = "test.odd.central",
                  people = "test.odd.people", metric = "test.odd.metric";

void check_fault(OddStage& stage, const char* kind, const std::string& function, const std::string& text) {
  const PluginFault fault = stage.fault();
  CHECK(fault.kind() == std::string(kind));
  CHECK(fault.function() == function);
  CHECK_THAT(fault.what(), Catch::Contains(text));
}

// The texts that a plugin logged which begin with `beginning`.
std::vector<std::string> logged(const Stage& stage, const std::string& beginning) {
  std::vector<std::string> out;
  for (const LogLine& line : stage.log)
    if (line.text.rfind(beginning, 0) == 0) out.push_back(line.plugin + ": " + line.text);
  return out;
}

TEST_CASE("a status that a function may not return is a breach that names it") {
  struct Case {
    std::string id, function;
    bool no_solution, timeout;  // allowed
  };
  const Case cases[] = {{planner, "plan", true, true},           {controller, "set_path", false, false},
                        {controller, "step", true, false},       {central, "step_all", false, false},
                        {people, "step", false, false},          {metric, "begin", false, false},
                        {metric, "observe", false, false},       {metric, "finish", false, false},
                        {controller, "trial_end", false, false}, {central, "set_path", false, false}};
  for (const auto& [id, function, no_solution, timeout] : cases) {
    INFO(id << " " << function);
    OddStage no_solution_stage(id, function + " 2", id == central ? id : "");
    if (no_solution)
      CHECK_THROWS_WITH(no_solution_stage.fault(), "no fault");
    else
      check_fault(no_solution_stage, fault_kind::abi_breach, function, "returned DMRP_NO_SOLUTION (2)");
    OddStage timeout_stage(id, function + " 3", id == central ? id : "");
    if (timeout)
      CHECK_THROWS_WITH(timeout_stage.fault(), "no fault");
    else
      check_fault(timeout_stage, fault_kind::abi_breach, function, "returned DMRP_TIMEOUT (3)");
    OddStage unknown_stage(id, function + " 99", id == central ? id : "");
    check_fault(unknown_stage, fault_kind::abi_breach, function, "status 99");
    OddStage warning_stage(id, function + " 1", id == central ? id : "");
    CHECK_THROWS_WITH(warning_stage.fault(), "no fault");
  }
}

TEST_CASE("plugins of a newer minor version work: the host reads the part that it knows") {
  const std::string id = GENERATE(planner, controller, central, people, metric);
  INFO(id);
  OddStage usual("", "", id == central ? id : "");
  usual.experiment.annotations = true;
  OddStage newer(id, "newer", id == central ? id : "");
  newer.experiment.annotations = true;
  CHECK(usual.run().succeeded);
  CHECK(newer.run().succeeded);
  CHECK(newer.reader->end()->t_ns == usual.reader->end()->t_ns);
  CHECK(newer.reader->notes().size() == usual.reader->notes().size());
  CHECK(newer.reader->trajectories().size() == usual.reader->trajectories().size());
  CHECK_FALSE(newer.reader->notes().empty());
  CHECK(newer.reader->notes()[0].text == "as planned");
  CHECK(newer.reader->trajectories()[0].poses.size() == 2);

  const MetricResult result = newer.measured();
  REQUIRE(result.values.size() == 1);
  CHECK(result.values[0].value == usual.measured().values[0].value);
  CHECK(result.values[0].value.value() > 100.0);  // free cells
  REQUIRE(result.events.size() == 1);
  const MetricEvent& event = result.events[0];
  CHECK(event.metric == "odd");
  CHECK(event.from_ns == 10);
  CHECK(event.to_ns == 20);
  CHECK(event.robots == std::vector<std::uint32_t>{1});
  CHECK(event.people == std::vector<std::uint64_t>{5});
  CHECK(event.severity == DMRP_SEVERITY_INFO);  // as an unknown one
  CHECK(event.text == "a\\nb");
  REQUIRE(event.place);
  CHECK(event.place->x == 1.5);
  CHECK(event.place->y == 2.5);
}

TEST_CASE("structs that are shorter than v1.0's are refused by the sinks") {
  for (const auto& [id, what, function, text] : {std::tuple(planner, "waypoint", "plan", "the host refuses the path"),
                                                 {planner, "path", "plan", "the host refuses the path"},
                                                 {metric, "result", "finish", "the host refuses the value"},
                                                 {metric, "event", "finish", "the host refuses the event"},
                                                 {metric, "subject", "finish", "the host refuses the event"}}) {
    INFO(what);
    OddStage stage(id, std::string("short ") + what);
    check_fault(stage, fault_kind::error_status, function, text);
  }
  for (const auto& [id, what, function, text] : {std::tuple(planner, "waypoint", "plan", "the host refuses the path"),
                                                 {metric, "subject", "finish", "the host refuses the event"}}) {
    INFO(what);
    OddStage stage(id, std::string("odd stride ") + what);
    check_fault(stage, fault_kind::error_status, function, text);
  }
  for (const std::string what : {"trajectory", "note"}) {
    OddStage stage(controller, "short " + what);
    stage.experiment.annotations = true;
    CHECK(stage.run().succeeded);
    CHECK(stage.reader->trajectories().empty() == (what == "trajectory"));
    CHECK(stage.reader->notes().empty() == (what == "note"));
  }
  OddStage stage(metric, "short request");
  stage.run();
  CHECK_FALSE(stage.measured().values.at(0).value);  // no walking grid
}

TEST_CASE("a function that writes beyond its output is a breach that names it") {
  for (const auto& [id, function, what] : {std::tuple(controller, "step", "dmrp_command"),
                                           {central, "step_all", "the commands"},
                                           {people, "step", "the motions"}}) {
    INFO(id);
    OddStage stage(id, std::string("overrun ") + function, id == central ? id : "");
    check_fault(stage, fault_kind::abi_breach, function, std::string("wrote beyond the end of ") + what);
  }
}

TEST_CASE("trial_end comes once after a trial without a fault, to all but metrics") {
  OddStage stage(people, "");
  stage.run();
  stage.measured();
  const std::string t_ns = std::to_string(stage.reader->end()->t_ns);
  const std::string text = "trial_end: ending 1 at " + t_ns + " ns, 2 robots";
  CHECK(logged(stage, "trial_end") == std::vector<std::string>{planner + ": " + text, controller + ": " + text,
                                                               controller + ": " + text, people + ": " + text});
  stage.run();
  CHECK(logged(stage, "trial_end").size() == 8);

  OddStage all("", "", central);
  all.run();
  CHECK(logged(all, "trial_end").size() == 2);  // of the planner and of the one controller

  OddStage no_plan(planner, "plan 2");
  no_plan.run();
  CHECK(logged(no_plan, "trial_end: ending 4").size() == 3);

  OddStage faulty(controller, "step 5");
  CHECK(faulty.fault().function() == std::string("step"));
  CHECK(logged(faulty, "trial_end").empty());
}

TEST_CASE("a central controller drives the active robots of every control tick, in order") {
  OddStage stage("", "", central);
  stage.experiment.annotations = true;
  REQUIRE(stage.run().succeeded);
  std::vector<std::string> expected;
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    std::string active;
    for (std::uint32_t i = 0; i < sample->robot_count; ++i)
      if (DMRP_AT(dmrp_robot_sample, sample->robots, sample->robot_stride, i)->state == DMRP_ROBOT_ACTIVE)
        active += std::to_string(i);
    if (sample->control_tick && !active.empty()) expected.push_back(central + ": drives " + active);
  }
  CHECK(logged(stage, "drives") == expected);
  CHECK(expected.front() == central + ": drives 01");
  CHECK(expected.back() != expected.front());  // one robot arrives before the other

  // it may annotate for each of its robots
  CHECK(stage.reader->notes()[0].source.robot == 0);
  CHECK(stage.reader->notes()[1].source.robot == 1);
}

TEST_CASE("a central controller drives as one controller a robot does") {
  OddStage one_each;
  OddStage all("", "", central);
  one_each.run();
  all.run();
  REQUIRE(all.reader->sample_count() == one_each.reader->sample_count());
  while (const dmrp_sample* sample = all.reader->next_sample()) {
    const dmrp_sample* const other = one_each.reader->next_sample();
    for (std::uint32_t i = 0; i < sample->robot_count; ++i) {
      const auto& a = *DMRP_AT(dmrp_robot_sample, sample->robots, sample->robot_stride, i);
      const auto& b = *DMRP_AT(dmrp_robot_sample, other->robots, other->robot_stride, i);
      REQUIRE((a.pose.x == b.pose.x && a.pose.y == b.pose.y && a.state == b.state));
    }
  }
}

TEST_CASE("a central controller brakes one robot, or is at fault for one") {
  OddStage brakes(central, "brake 0", central);
  CHECK_FALSE(brakes.run().succeeded);
  const dmrp_trial_end& end = *brakes.reader->end();
  const auto robot = [&](std::uint32_t i) { return *DMRP_AT(dmrp_robot_end, end.robots, end.robot_stride, i); };
  CHECK(robot(0).failure == DMRP_FAILURE_CONTROLLER);
  CHECK(robot(1).state == DMRP_ROBOT_FINISHED);

  OddStage nan(central, "nan 1", central);
  const PluginFault fault = nan.fault();
  CHECK(fault.kind() == std::string(fault_kind::bad_output));
  CHECK(fault.function() == std::string("step_all"));
  CHECK(fault.robot() == 1);
  CHECK_THAT(fault.what(), Catch::Contains("nan"));

  OddStage status(central, "status 1", central);
  const PluginFault breach = status.fault();
  CHECK(breach.kind() == std::string(fault_kind::abi_breach));
  CHECK(breach.robot() == 1);
  CHECK(breach.what() == std::string("gave the status 99, which status.h does not allow a command"));
}

TEST_CASE("a plugin or a table with a reserved field that is set is refused") {
  OddStage plugin(planner, "reserved plugin");
  check_fault(plugin, fault_kind::abi_breach, "create", "returned OK with 7 in dmrp_plugin.reserved, which must be 0");
  OddStage table(controller, "reserved table");
  check_fault(table, fault_kind::abi_breach, "create",
              "returned OK with 7 in dmrp_plugin.table->reserved, which must be 0");
}

TEST_CASE("a request for a walking grid with a reserved field that is set is refused") {
  OddStage request(metric, "reserved request");
  check_fault(request, fault_kind::abi_breach, "finish",
              "asked with 7 in dmrp_walking_grid_request.reserved, which must be 0");
}

TEST_CASE("a path with a reserved field or an unknown flag that is set is refused") {
  OddStage waypoint(planner, "reserved waypoint");
  check_fault(waypoint, fault_kind::error_status, "plan", "a reserved field of its waypoints is 7, not 0");
  OddStage flags(planner, "unknown flags");
  check_fault(flags, fault_kind::error_status, "plan", "its flags are 0x8, which this host does not know");
}

TEST_CASE("a partial path is refused where no window was asked for") {
  OddStage stage(planner, "partial");
  check_fault(stage, fault_kind::bad_output, "plan", "robot 0 has a partial path, but the whole way was asked for");
}

TEST_CASE("a plugin may say that a trial is not for it, and that is no breach") {
  for (const auto& [id, function] :
       {std::pair(planner, "start"), {planner, "plan"}, {controller, "start"}, {people, "start"}}) {
    INFO(id << " " << function);
    OddStage stage(id, std::string(function) + " 7");
    check_fault(stage, fault_kind::unsupported, function, "DMRP_UNSUPPORTED");
  }
  for (const std::string function : {"start", "begin"}) {
    OddStage stage(metric, function + " 7");
    stage.run();
    const MetricResult result = stage.measured();
    REQUIRE(result.values.size() == 1);
    CHECK(result.values[0].metric == "odd");
    CHECK_FALSE(result.values[0].value);
    CHECK(result.events.empty());
  }
  for (const auto& [id, function] : {std::pair(controller, "set_path"),
                                     {controller, "step"},
                                     {people, "step"},
                                     {planner, "trial_end"},
                                     {metric, "observe"},
                                     {metric, "finish"}}) {
    INFO(id << " " << function);
    OddStage stage(id, std::string(function) + " 7");
    check_fault(stage, fault_kind::abi_breach, function, "DMRP_UNSUPPORTED (7)");
  }
}

}  // namespace odd_trials_test
