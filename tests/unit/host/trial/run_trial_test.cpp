// SPDX-License-Identifier: MIT
// A trial and its metrics in this process, with plugins that check their inputs (trial_plugins.cpp).
#include "host/trial/run_trial.hpp"

#include <dmrp/ext/annotate.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/guests/inside/measure.hpp"
#include "tests/support/instance_pool.hpp"
#include "tests/unit/host/trial/stage.hpp"

namespace run_trial_test {

using namespace dmrp::host;
namespace core = dmrp::core;
namespace test = dmrp::test;

// Plugins that check what the host gives them.
struct CheckedStage : test::Stage {
  explicit CheckedStage(std::size_t robots = 2, const std::string& planner_does = "plan",
                        const std::string& controller_does = "drive", double planner_time_s = 60.0)
      : Stage(DMRP_TRIAL_PLUGINS, {"test.planner.straight", "test.controller.careful", "", "test.metric.sink"},
              test::hall(robots)) {
    experiment.global_planners[0].parameters[0].text = planner_does;
    experiment.local_controllers[0].parameters[0].text = controller_does;
    experiment.limits.planner_time_s = planner_time_s;
  }
};

// All robots at all samples.
std::vector<dmrp_robot_sample> motion(core::TraceReader& trace) {
  std::vector<dmrp_robot_sample> all;
  trace.rewind();
  while (const dmrp_sample* sample = trace.next_sample())
    for (std::uint32_t i = 0; i < sample->robot_count; ++i)
      all.push_back(*DMRP_AT(dmrp_robot_sample, sample->robots, sample->robot_stride, i));
  return all;
}

double system_of(const MetricResult& result, const std::string& name) {
  for (const MetricValue& value : result.values)
    if (value.metric == name && value.subject_kind == DMRP_SUBJECT_SYSTEM && !value.coordinate)
      return value.value.value();
  throw std::runtime_error("no value of " + name);
}

TEST_CASE("a trial keeps its word to every plugin, and the next one does not remember it") {
  const std::size_t robots = GENERATE(std::size_t{1}, std::size_t{2});
  CheckedStage stage(robots);
  const TrialEnding ending = stage.run();
  CHECK(ending.succeeded);
  CHECK(stage.guard.timing().empty());
  REQUIRE(stage.reader->end());
  CHECK(stage.reader->end()->ending == DMRP_ENDING_ARRIVED);
  CHECK(ending.sim_time_s == static_cast<double>(stage.reader->end()->t_ns) / 1e9);  // as metrics give it
  const auto first = motion(*stage.reader);
  // 7 cells and a leg of 0.3 m, up to the tolerance
  CHECK(first[first.size() - robots].progress_m == Approx(7.3).margin(0.21));

  CHECK(stage.run().succeeded);
  const auto second = motion(*stage.reader);
  REQUIRE(first.size() == second.size());
  CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(first[0])) == 0);
}

TEST_CASE("a given plan takes the place of a call where nothing can replan") {
  CheckedStage first;
  PlannerAnswer made;
  first.first_plan.on_made = [&](const PlannerAnswer& answer) { made = answer; };
  CHECK(first.run().succeeded);
  REQUIRE(made.paths.size() == 2);

  CheckedStage second(2, "nothing");
  bool asked = false;
  second.first_plan = {&made, [&](const PlannerAnswer&) { asked = true; }};
  CHECK(second.run().succeeded);
  CHECK_FALSE(asked);
  CHECK(second.reader->first_plan()->planning_ns == first.reader->first_plan()->planning_ns);
  const auto one = motion(*first.reader);
  const auto other = motion(*second.reader);
  REQUIRE(one.size() == other.size());
  CHECK(std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0);

  CheckedStage replans(2, "nothing");
  replans.experiment.simulation.replan.period_ns = 1'000'000'000;
  replans.first_plan = {&made, [&](const PlannerAnswer&) { asked = true; }};
  CHECK_FALSE(replans.run().succeeded);
  CHECK(asked);
}

TEST_CASE("what plugins say goes to the trace where it is wanted, and changes nothing else") {
  CheckedStage silent;
  silent.run();
  CHECK(silent.reader->trajectories().empty());
  CHECK(silent.reader->notes().empty());

  CheckedStage open;
  open.experiment.annotations = true;
  open.run();
  const auto& trajectories = open.reader->trajectories();
  const auto& notes = open.reader->notes();
  REQUIRE(trajectories.size() > 20);
  CHECK(trajectories[0].source.plugin_kind == DMRP_KIND_LOCAL_CONTROLLER);
  CHECK(trajectories[0].source.robot == 0);
  CHECK(trajectories[0].t_ns == 0);
  CHECK(trajectories[0].role == DMRP_ANNOTATE_PREDICTED);
  CHECK(trajectories[0].step_ns == 100'000'000);
  REQUIRE(trajectories[0].poses.size() == 2);  // the third is not finite
  CHECK(trajectories[0].poses[1].x == 2.5);
  CHECK(trajectories[1].role == DMRP_ANNOTATE_CANDIDATE);
  CHECK(trajectories[1].poses.size() == 1000);
  CHECK(trajectories[2].source.robot == 1);
  CHECK(trajectories[4].t_ns == 100'000'000);
  for (std::size_t i = 4; i < trajectories.size(); ++i) CHECK(trajectories[i].poses.size() == 2);
  REQUIRE(notes.size() == 3);
  CHECK(notes[0].source.plugin_kind == DMRP_KIND_GLOBAL_PLANNER);
  CHECK(notes[0].text == "straight");
  CHECK(notes[1].text == std::string(999, 'n'));  // no partial character

  const auto one = motion(*silent.reader);
  const auto other = motion(*open.reader);
  REQUIRE(one.size() == other.size());
  CHECK(std::memcmp(one.data(), other.data(), one.size() * sizeof(one[0])) == 0);
  const MetricResult before = silent.measured();
  const MetricResult after = open.measured();
  REQUIRE(before.values.size() == after.values.size());
  for (std::size_t i = 0; i < before.values.size(); ++i) CHECK(before.values[i].value == after.values[i].value);

  open.experiment.traces = RecordTraces::none;
  open.run();
  CHECK(open.reader->trajectories().empty());
}

TEST_CASE("no plan is a result: nothing moves, everything is measured") {
  const std::string does = GENERATE("nothing", "timeout");
  CheckedStage stage(2, does);
  CHECK_FALSE(stage.run().succeeded);
  CHECK(stage.reader->end()->ending == DMRP_ENDING_NO_PLAN);
  CHECK(stage.reader->first_plan() == nullptr);
  CHECK(stage.reader->sample_count() == 1);
  REQUIRE(stage.reader->plans().size() == 1);
  CHECK(stage.reader->plans()[0].plan.status == (does == "timeout" ? DMRP_TIMEOUT : DMRP_NO_SOLUTION));
  const MetricResult result = stage.measured();
  CHECK(result.index == 0);
  CHECK(system_of(result, "samples") == 0.0);
  // a metric of calls sees the one without a plan
  PluginUse use = stage.experiment.metrics[0];
  use.info.channels = DMRP_CHANNEL_CALLS;
  InstancePool pool(stage.experiment.libraries, stage.guard, [](auto, const auto&, const auto&) {});
  const MetricResult of_calls =
      measure(*stage.reader, stage.variant->walking_grids, pool.get(use, DMRP_NO_ROBOT), use.info, 0, 1, 1'000'000'000);
  CHECK(system_of(of_calls, "samples") == 1.0);
  stage.reader->rewind();
  const dmrp_sample* sample = stage.reader->next_sample();
  REQUIRE(sample->call_count == 1);
  CHECK(sample->calls->kind == DMRP_CALL_PLAN);
  CHECK(sample->calls->status == stage.reader->plans()[0].plan.status);
  CHECK(sample->calls->robot == DMRP_ALL_ROBOTS);
  CHECK(sample->calls->duration_ns == stage.reader->plans()[0].plan.planning_ns);
  REQUIRE(sample->event_count == 2);  // the class of each robot
  CHECK(sample->events[0].kind == DMRP_ROBOT_EVENT_CLASS);
  CHECK(sample->events[1].robot == 1);
}

TEST_CASE("a metric gets no people, calls and routes that it does not declare") {
  CheckedStage stage;
  stage.experiment.scenarios[0].scenario.tracks = {{{{0, {1.0, 5.0}}, {2'000'000'000, {3.0, 5.0}}}}};
  stage.run();
  CHECK(system_of(stage.measured(), "of_channels") == 0.0);
  std::size_t all = 0;
  stage.reader->rewind();
  while (const dmrp_sample* sample = stage.reader->next_sample())
    all += sample->person_count + sample->call_count + sample->route_count;
  CHECK(all > 100);
  PluginUse use = stage.experiment.metrics[0];
  use.info.channels = DMRP_CHANNEL_PEOPLE | DMRP_CHANNEL_CALLS | DMRP_CHANNEL_ROUTES;
  InstancePool pool(stage.experiment.libraries, stage.guard, [](auto, const auto&, const auto&) {});
  const MetricResult declared =
      measure(*stage.reader, stage.variant->walking_grids, pool.get(use, DMRP_NO_ROBOT), use.info, 0, 1, 1'000'000'000);
  CHECK(system_of(declared, "of_channels") == static_cast<double>(all));
}

TEST_CASE("the processor time of planning leaves out what the planner waits for") {
  CheckedStage stage(1, "sleep");
  stage.run();
  const dmrp_plan* plan = stage.reader->first_plan();
  REQUIRE(plan);
  CHECK(plan->processor_ns > 0);
  CHECK(plan->planning_ns >= 50'000'000);
  CHECK(plan->processor_ns < plan->planning_ns / 2);
}

TEST_CASE("a trial without robots plans nothing, and is over when everybody has left") {
  CheckedStage stage(0);
  stage.experiment.scenarios[0].scenario.tracks = {{{{0, {1.0, 1.0}}, {2'000'000'000, {3.0, 1.0}}}},
                                                   {{{1'000'000'000, {5.0, 5.0}}, {3'000'000'000, {5.0, 4.0}}}}};
  stage.combination = {0, -1, -1, -1};
  const TrialEnding ending = stage.run();
  CHECK(ending.succeeded);
  CHECK(ending.sim_time_s == 3.02);
  CHECK(stage.reader->end()->ending == DMRP_ENDING_DESERTED);
  CHECK(stage.reader->plans().empty());
  CHECK(stage.reader->world().person_count == 2);
  std::vector<std::uint32_t> counts;
  while (const dmrp_sample* sample = stage.reader->next_sample()) {
    CHECK(sample->plan == nullptr);
    if (counts.empty() || counts.back() != sample->person_count) counts.push_back(sample->person_count);
  }
  CHECK(counts == std::vector<std::uint32_t>{1, 2, 1, 0});
  CHECK(stage.reader->sample_count() == 152);
}

TEST_CASE("a whole plan that came late counts") {
  CheckedStage stage(2, "late");
  CHECK(stage.run().succeeded);
  CHECK(stage.reader->first_plan()->status == DMRP_TIMEOUT);
  REQUIRE(stage.reader->first_plan()->statistic_count == 1);
  CHECK(stage.reader->first_plan()->statistics->value == 12.5);
}

TEST_CASE("a planner that was told to stop is remembered") {
  CheckedStage stage(1, "wait", "drive", 0.01);
  CHECK(stage.run().succeeded);
  CHECK(stage.guard.timing().size() == 1);
}

TEST_CASE("what plugins break is a fault with its place, and the pool goes on") {
  SECTION("a plan for one robot of two") {
    CheckedStage stage(2, "half");
    const PluginFault fault = stage.fault();
    CHECK(fault.kind() == std::string(fault_kind::bad_output));
    CHECK(fault.plugin() == "test.planner.straight");
    CHECK(fault.function() == std::string("plan"));
    CHECK_FALSE(fault.fatal());
  }
  SECTION("a command that is no number") {
    CheckedStage stage(2, "plan", "nan");
    const PluginFault fault = stage.fault();
    CHECK(fault.kind() == std::string(fault_kind::bad_output));
    CHECK(fault.plugin() == "test.controller.careful");
    CHECK(fault.step() == 5);  // the second control tick
    CHECK(fault.robot() == 0);
    CHECK(stage.fault().step() == 5);
  }
  SECTION("a library that is lost") {
    CheckedStage stage(2, "fatal");
    const PluginFault fault = stage.fault();
    CHECK(fault.fatal());
    CHECK(fault.what() == std::string("the library is lost"));
  }
}

TEST_CASE("controllers that find no command fail their robots, not the trial") {
  CheckedStage stage(2, "plan", "nothing");
  CHECK_FALSE(stage.run().succeeded);
  const dmrp_trial_end& end = *stage.reader->end();
  CHECK(end.t_ns < 30'000'000'000);
  for (std::uint32_t i = 0; i < end.robot_count; ++i) {
    const auto& robot = *DMRP_AT(dmrp_robot_end, end.robots, end.robot_stride, i);
    CHECK(robot.state == DMRP_ROBOT_FAILED);
    CHECK(robot.failure == DMRP_FAILURE_CONTROLLER);
    CHECK(robot.arrival_ns == -1);
  }
}

TEST_CASE("a metric's values are taken as they are declared") {
  CheckedStage stage;
  stage.run();
  const MetricResult result = stage.measured();
  CHECK(system_of(result, "samples") == static_cast<double>(stage.reader->sample_count()));
  CHECK(system_of(result, "refused") == 12.0);
  CHECK(result.values.size() == 7);
  REQUIRE(result.events.size() == 1);
  CHECK(result.events[0].metric == "samples");
  CHECK(result.events[0].robots == std::vector<std::uint32_t>{0, 1});
  CHECK(result.events[0].people == std::vector<std::uint64_t>{9});
  CHECK(result.events[0].severity == DMRP_SEVERITY_SERIOUS);
  REQUIRE(result.events[0].place);
  CHECK(result.events[0].place->x == 1.5);
  CHECK(result.events[0].place->y == 2.5);
  for (const MetricValue& value : result.values) CHECK(value.value.has_value() == (value.metric != "undefined"));

  // again from the start, and the same
  CHECK(system_of(stage.measured(), "samples") == system_of(result, "samples"));
}

TEST_CASE("a metric that is silent about a declared value is at fault") {
  CheckedStage stage;
  stage.experiment.metrics[0].parameters[0].integer = 1;
  stage.run();
  // with the first thing that the host did not take
  CHECK_THROWS_WITH(
      stage.measured(),
      "gave no system value of undefined (the host refused the event 'samples': robot 2, but there are 2)");
}

TEST_CASE("a trace that was cut short is not measured") {
  CheckedStage stage;
  stage.open();
  stage.trace = std::make_unique<test::TraceInMemory>(stage.variant->view.world());
  CHECK_THROWS_AS(stage.measured(), std::invalid_argument);
}

TEST_CASE("every ending has its text") {
  CHECK(ending_text(DMRP_ENDING_ARRIVED) == std::string("all robots arrived"));
  CHECK(ending_text(DMRP_ENDING_TIME_LIMIT) == std::string("time limit"));
  CHECK(ending_text(DMRP_ENDING_DEADLOCK) == std::string("deadlock"));
  CHECK(ending_text(DMRP_ENDING_NO_PLAN) == std::string("the planner found no plan"));
  CHECK(ending_text(DMRP_ENDING_DESERTED) == std::string("everybody left"));
  CHECK(ending_text(0) == std::string());
}

}  // namespace run_trial_test
