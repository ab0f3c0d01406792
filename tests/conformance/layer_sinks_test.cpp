// SPDX-License-Identifier: MIT
// Planners, pedestrian models and metrics, called as a host calls them: what they read and what they write.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "tests/conformance/calls.hpp"

using namespace dmrp::test;

namespace {

// A plan sink that writes down what it gets, and answers as it is told.
struct PlanSink {
  std::vector<std::vector<double>> paths;
  std::vector<std::uint32_t> flags;
  std::vector<std::string> statistics;
  std::int32_t answer_path = DMRP_OK, answer_statistic = DMRP_OK;
  dmrp_plan_sink c{};

  PlanSink() {
    c.struct_size = sizeof(c);
    c.context = this;
    c.path = [](dmrp_plan_sink* self, std::uint32_t robot, const dmrp_path* path) {
      auto& to = *static_cast<PlanSink*>(self->context);
      to.paths.push_back({1.0 * robot});
      to.flags.push_back(path->flags);
      for (std::uint32_t i = 0; i < path->count; ++i)
        to.paths.back().push_back(DMRP_AT(dmrp_waypoint, path->waypoints, path->stride, i)->x);
      return to.answer_path;
    };
    c.statistic = [](dmrp_plan_sink* self, const char* name, double value) {
      auto& to = *static_cast<PlanSink*>(self->context);
      to.statistics.push_back(name + std::string("=") + std::to_string(value));
      return to.answer_statistic;
    };
  }
  PlanSink(const PlanSink&) = delete;
  PlanSink& operator=(const PlanSink&) = delete;
};

// Two robots on a grid with two goals and one, and the plan in force, if there is one.
struct Problem {
  std::vector<Longer<dmrp_goal>> goals{2};
  std::vector<Longer<dmrp_planning_robot>> robots{2};
  dmrp_grid grid{};
  dmrp_planning_problem c{};

  Problem() {
    goals[0].known.pose.x = 5.0;
    goals[1].known.pose.x = 6.0;
    for (std::size_t i = 0; i < 2; ++i) {
      robots[i].known.goals = &goals.front().known;
      robots[i].known.goal_stride = sizeof(goals.front());
      robots[i].known.goal_count = static_cast<std::uint32_t>(2 - i);
      robots[i].known.start = {static_cast<double>(i), 0.0};
    }
    grid.width = 7;
    c.struct_size = sizeof(c);
    c.grid = &grid;
    c.robots = &robots.front().known;
    c.robot_count = 2;
    c.robot_stride = sizeof(robots.front());
  }
  Problem(const Problem&) = delete;
  Problem& operator=(const Problem&) = delete;
};

// A metric sink that writes down what it gets, and answers as it is told.
struct MetricSink {
  std::vector<std::string> said;
  std::int32_t answer_value = DMRP_OK, answer_event = DMRP_OK;
  dmrp_metric_sink c{};

  MetricSink() {
    c.struct_size = sizeof(c);
    c.context = this;
    c.value = [](dmrp_metric_sink* self, const dmrp_metric_result* result) {
      auto& to = *static_cast<MetricSink*>(self->context);
      to.said.push_back(std::string(result->name) + " " + std::to_string(result->subject_kind) + " " +
                        std::to_string(result->subject) + " " + tenths(result->coordinate) + " " +
                        tenths(result->value));
      return to.answer_value;
    };
    c.event = [](dmrp_metric_sink* self, const dmrp_event* event) {
      auto& to = *static_cast<MetricSink*>(self->context);
      std::string line = std::string(event->name) + " " + std::to_string(event->from_ns) + ".." +
                         std::to_string(event->to_ns) + " !" + std::to_string(event->severity);
      for (std::uint32_t i = 0; i < event->subject_count; ++i) {
        const auto* subject = DMRP_AT(dmrp_subject, event->subjects, event->subject_stride, i);
        line += " " + std::to_string(subject->kind) + ":" + std::to_string(subject->id);
      }
      to.said.push_back(line + " at " + tenths(event->place.x) + "," + tenths(event->place.y) + " " + event->text);
      return to.answer_event;
    };
  }
  MetricSink(const MetricSink&) = delete;
  MetricSink& operator=(const MetricSink&) = delete;

  static std::string tenths(double x) { return std::isnan(x) ? "-" : std::to_string(std::lround(10.0 * x)); }
};

// A plan of two paths, one sample and the end of a trial.
struct Trial {
  PathAlongX first{2}, second{4};
  std::vector<Longer<dmrp_path>> paths{{first.c()}, {second.c()}};
  dmrp_plan plan{};
  std::vector<Longer<dmrp_robot_sample>> robots{2};
  std::vector<Longer<dmrp_person>> people{1};
  std::vector<Longer<dmrp_contact>> contacts{1};
  std::vector<Longer<dmrp_call>> calls{2};
  std::vector<Longer<dmrp_robot_event>> events{2};
  PathAlongX way{2};
  Longer<dmrp_path> path{way.c()};
  std::vector<Longer<dmrp_route>> routes{{{1, DMRP_PATH_CONTINUES, &path.known}}};
  dmrp_sample sample{};
  std::vector<Longer<dmrp_robot_end>> ends{2};
  dmrp_trial_end end{};

  Trial() {
    plan.struct_size = sizeof(plan);
    plan.path_count = 2;
    plan.paths = &paths.front().known;
    plan.path_stride = sizeof(paths.front());
    robots[0].known.pose.x = 1.0;
    robots[1].known.pose.x = 2.0;
    people[0].known.position.x = 3.0;
    contacts[0].known.depth_m = 0.5;
    calls[1].known.duration_ns = 77;
    sample.struct_size = sizeof(sample);
    sample.control_tick = 1;
    sample.robots = &robots.front().known;
    sample.robot_count = 2;
    sample.robot_stride = sizeof(robots.front());
    sample.people = &people.front().known;
    sample.person_count = 1;
    sample.person_stride = sizeof(people.front());
    sample.contacts = &contacts.front().known;
    sample.contact_count = 1;
    sample.contact_stride = sizeof(contacts.front());
    sample.calls = &calls.front().known;
    sample.call_count = 2;
    sample.call_stride = sizeof(calls.front());
    events[0].known.detail = DMRP_RECOVERY_SPIN;
    events[1].known.detail = 88;
    sample.events = &events.front().known;
    sample.event_count = 2;
    sample.event_stride = sizeof(events.front());
    sample.routes = &routes.front().known;
    sample.route_count = 1;
    sample.route_stride = sizeof(routes.front());
    end = {sizeof(end), DMRP_ENDING_ARRIVED, 3'000'000'000, &ends.front().known, 2, sizeof(ends.front())};
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
};

}  // namespace

TEST_CASE("a planner reads the problem by its strides and writes into the sink") {
  const Problem problem;
  const auto plan = [&](const Sample& s, PlanSink& sink) {
    return s.as<dmrp_global_planner>().plan(s.c.self, &problem.c, &sink.c);
  };
  check_outcomes("sample.planner", true, [&](const Sample& s) {
    PlanSink sink;
    return plan(s, sink);
  });

  const Sample sample("sample.planner", "nothing");
  PlanSink sink;
  REQUIRE(plan(sample, sink) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{7.0, 0.0});
  CHECK(sink.paths == std::vector<std::vector<double>>{{0.0, 0.0, 5.0, 6.0}, {1.0, 1.0, 5.0}});
  CHECK(sink.flags == std::vector<std::uint32_t>{0, 0});
  CHECK(sink.statistics == std::vector<std::string>{"cost=3.000000"});

  PlanSink of_window;
  REQUIRE(plan(Sample("sample.planner", "give partial paths"), of_window) == DMRP_OK);
  CHECK(of_window.flags == std::vector<std::uint32_t>{DMRP_PATH_PARTIAL, DMRP_PATH_PARTIAL});
}

TEST_CASE("a planner reads the plan in force by its stride") {
  PathAlongX first{2}, second{4};
  std::vector<Longer<dmrp_path>> paths{{first.c()}, {second.c()}};
  paths[1].known.flags = DMRP_PATH_PARTIAL;
  Problem problem;
  problem.c.in_force = &paths.front().known;
  problem.c.in_force_count = 2;
  problem.c.in_force_stride = sizeof(paths.front());
  const Sample sample("sample.planner", "nothing");
  PlanSink sink;
  REQUIRE(sample.as<dmrp_global_planner>().plan(sample.c.self, &problem.c, &sink.c) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{7.0, 2.0, 1.0, 3.0, 0.0, 1.0});
}

TEST_CASE("a planner reads the window and how much time it has left") {
  Problem problem;
  problem.c.window_steps = 12;
  Sample sample("sample.windowed", "nothing");
  sample.host.budget_left_ns = 250'000'000;
  PlanSink sink;
  REQUIRE(sample.as<dmrp_global_planner>().plan(sample.c.self, &problem.c, &sink.c) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{12.0, 0.25});
  const Sample not_for_it("sample.windowed", "unsupported");
  CHECK(not_for_it.as<dmrp_global_planner>().plan(not_for_it.c.self, &problem.c, &sink.c) == DMRP_UNSUPPORTED);
}

TEST_CASE("what the host refuses of a plan ends the call with a text, what it has no memory for with that status") {
  const Problem problem;
  Sample sample("sample.planner", "nothing");
  const auto plan = [&](std::int32_t answer_path, std::int32_t answer_statistic) {
    PlanSink sink;
    sink.answer_path = answer_path;
    sink.answer_statistic = answer_statistic;
    sample.host.error.clear();
    return sample.as<dmrp_global_planner>().plan(sample.c.self, &problem.c, &sink.c);
  };
  CHECK(plan(DMRP_ERROR, DMRP_OK) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused the path of robot 0");
  CHECK(plan(DMRP_OK, DMRP_ERROR) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused cost");
  CHECK(plan(DMRP_OUT_OF_MEMORY, DMRP_OK) == DMRP_OUT_OF_MEMORY);
  CHECK(plan(DMRP_OK, DMRP_OUT_OF_MEMORY) == DMRP_OUT_OF_MEMORY);
}

TEST_CASE("a pedestrian model gives a motion to each person and writes no further") {
  std::vector<Longer<dmrp_person>> people(3);
  for (std::size_t i = 0; i < people.size(); ++i) people[i].known.id = 20 + i;
  std::vector<Longer<dmrp_agent>> robots(2);
  dmrp_crowd crowd{};
  crowd.struct_size = sizeof(crowd);
  crowd.people = &people.front().known;
  crowd.person_count = 3;
  crowd.person_stride = sizeof(people.front());
  crowd.robots = &robots.front().known;
  crowd.robot_count = 2;
  crowd.robot_stride = sizeof(robots.front());
  // a newer host: the plugin must not write the additional fields of a motion, nor the motion after the last
  std::vector<Longer<dmrp_motion>> motions(4);
  dmrp_motions out = {sizeof(out), 3, sizeof(motions.front()), 0, &motions.front().known};

  check_outcomes("sample.pedestrian", true,
                 [&](const Sample& s) { return s.as<dmrp_pedestrian_model>().step(s.c.self, &crowd, &out); });
  for (std::size_t i = 0; i < motions.size(); ++i) {
    CHECK(motions[i].known.velocity.x == (i < 3 ? 20.0 + static_cast<double>(i) : 0.0));
    CHECK(motions[i].known.velocity.y == (i < 3 ? 2.0 : 0.0));
    CHECK(motions[i].unknown == 0x5555555555555555u);
  }
}

TEST_CASE("a metric sees plan, samples and end, and its values reach the sink as given") {
  const Trial trial;
  dmrp_metric_trial beginning = {sizeof(beginning), 0, &trial.plan};
  const auto begin = [&](const Sample& s) { return s.as<dmrp_metric>().begin(s.c.self, &beginning); };
  const auto observe = [&](const Sample& s) { return s.as<dmrp_metric>().observe(s.c.self, &trial.sample); };
  MetricSink sink;
  const auto finish = [&](const Sample& s) { return s.as<dmrp_metric>().finish(s.c.self, &trial.end, &sink.c); };
  check_outcomes("sample.metric", false, begin);
  check_outcomes("sample.metric", false, observe);
  check_outcomes("sample.metric", false, finish);

  const Sample sample("sample.metric", "nothing");
  REQUIRE(begin(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{4.0});
  REQUIRE(observe(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{1.0, 1.0, 2.0, 3.0, 0.5, 0.0, 77.0, 2.0, 88.0, 0.0, 1.0, 1.0, 0.0});
  sink.said.clear();
  REQUIRE(finish(sample) == DMRP_OK);
  CHECK(sink.said == std::vector<std::string>{"plain 0 0 - 30", "timed 1 1 - -", "curved 2 12 - 10", "curved 0 0 5 20",
                                              "plain 1..2 !0 1:3 2:40 at -,- an event", "other 3..3 !2 at 10,20 "});

  beginning.plan = nullptr;  // planning failed
  REQUIRE(begin(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{-1.0});
}

TEST_CASE("what the host refuses of a metric ends the call with a text, what it has no memory for with that status") {
  const Trial trial;
  Sample sample("sample.metric", "nothing");
  const auto finish = [&](std::int32_t answer_value, std::int32_t answer_event) {
    MetricSink sink;
    sink.answer_value = answer_value;
    sink.answer_event = answer_event;
    sample.host.error.clear();
    return sample.as<dmrp_metric>().finish(sample.c.self, &trial.end, &sink.c);
  };
  CHECK(finish(DMRP_ERROR, DMRP_OK) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused a value of plain");
  CHECK(finish(DMRP_OK, DMRP_ERROR) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused an event of plain");
  CHECK(finish(DMRP_OUT_OF_MEMORY, DMRP_OK) == DMRP_OUT_OF_MEMORY);
  CHECK(finish(DMRP_OK, DMRP_OUT_OF_MEMORY) == DMRP_OUT_OF_MEMORY);
}
