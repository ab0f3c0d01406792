// SPDX-License-Identifier: MIT
// Every function of every kind, called as a host calls it: arguments, results and errors.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "tests/conformance/sample_library.hpp"

using namespace dmrp::test;

namespace {

// An array element of a newer host, with fields that the plugin does not know.
template <class T>
struct Longer {
  T known;
  std::uint64_t unknown = 0x5555555555555555u;
};

template <class T>
std::uint32_t count_of(const std::vector<T>& elements) {
  return static_cast<std::uint32_t>(elements.size());
}

struct CallOutcome {
  const char* does;
  std::int32_t status;
  const char* text;
};
constexpr CallOutcome outcomes[] = {
    {"nothing", DMRP_OK, ""},
    {"throw", DMRP_ERROR, "thrown on purpose"},
    {"throw bad_alloc", DMRP_OUT_OF_MEMORY, ""},
    {"throw number", DMRP_ERROR, "an exception that is no std::exception"},
};
constexpr CallOutcome statuses[] = {{"warning", DMRP_WARNING, ""}, {"no solution", DMRP_NO_SOLUTION, ""}};

// Calls `call(sample)` on an instance of `id` for each kind of return.
template <class Call>
void check_outcomes(const char* id, bool returns_status, Call&& call) {
  std::vector<CallOutcome> all(std::begin(outcomes), std::end(outcomes));
  if (returns_status) all.insert(all.end(), std::begin(statuses), std::end(statuses));
  for (const CallOutcome& outcome : all) {
    CAPTURE(id, outcome.does);
    const Sample sample(id, outcome.does);
    CHECK(call(sample) == outcome.status);
    CHECK(sample.host.error == outcome.text);
  }
}

struct Path {
  std::vector<Longer<dmrp_waypoint>> waypoints;
  dmrp_path c() const {
    return {sizeof(dmrp_path), count_of(waypoints), sizeof(Longer<dmrp_waypoint>), 0, &waypoints.front().known};
  }
};
Path path_along_x(int count) {
  Path path;
  for (int i = 0; i < count; ++i) path.waypoints.push_back({{1.0 * i, 0.0, 0.0, i, 0, 0}});
  return path;
}

struct Scene {
  dmrp_limits limits = {sizeof(dmrp_limits), 0, 0.0, 0.8, 0.0, 1.0, 1.0, 1.0};
  dmrp_footprint footprint = {sizeof(dmrp_footprint), 0, 0.25, 0.25, nullptr};
  std::vector<Longer<dmrp_agent>> agents;
  dmrp_observation observation{};

  Scene() {
    for (std::uint64_t id : {11u, 12u, 13u}) agents.push_back({{id, DMRP_AGENT_PERSON, 0, {}, {}, 0.3}});
    observation.struct_size = sizeof(observation);
    observation.t_ns = 1'500'000'000;
    observation.pose = {3.0, 4.0, 0.0};
    observation.limits = &limits;
    observation.footprint = &footprint;
    observation.agents = &agents.front().known;
    observation.agent_count = count_of(agents);
    observation.agent_stride = sizeof(Longer<dmrp_agent>);
  }
};

}  // namespace

TEST_CASE("a span walks elements by their owner's stride") {
  std::vector<Longer<dmrp_vec2>> points;
  for (int i = 0; i < 5; ++i) points.push_back({{1.0 * i, 10.0 * i}});
  const dmrp::Span<dmrp_vec2> span(&points.front().known, points.size(), sizeof(points.front()));

  REQUIRE(span.size() == 5);
  for (std::size_t i = 0; i < span.size(); ++i) CHECK(span[i].y == 10.0 * static_cast<double>(i));
  CHECK(span.front().x == 0.0);
  CHECK(span.back().x == 4.0);
  CHECK(span.end() - span.begin() == 5);
  CHECK((span.begin() + 3)->x == 3.0);
  CHECK(span.begin()[2].x == 2.0);
  CHECK(std::vector<dmrp_vec2>(span.begin(), span.end()).size() == 5);
  const auto found =
      std::lower_bound(span.begin(), span.end(), 2.5, [](const dmrp_vec2& point, double x) { return point.x < x; });
  CHECK(found - span.begin() == 3);
  auto last = span.end();
  CHECK((--last)->x == 4.0);
  CHECK(dmrp::Span<dmrp_vec2>().empty());
}

TEST_CASE("DMRP_HAS tells which fields a shorter or longer struct holds") {
  dmrp_command command{};
  command.struct_size = sizeof(command);
  CHECK(DMRP_HAS(&command, omega));
  command.struct_size = offsetof(dmrp_command, omega);
  CHECK(DMRP_HAS(&command, v_y));
  CHECK(!DMRP_HAS(&command, omega));
  command.struct_size = offsetof(dmrp_command, omega) + 4;  // half a field does not count
  CHECK(!DMRP_HAS(&command, omega));
  CHECK(DMRP_STRIDE_HAS(dmrp_waypoint, sizeof(dmrp_waypoint), reserved));
  CHECK(!DMRP_STRIDE_HAS(dmrp_waypoint, offsetof(dmrp_waypoint, reserved), reserved));
  CHECK(DMRP_STRIDE_HAS(dmrp_waypoint, sizeof(Longer<dmrp_waypoint>), reserved));
}

TEST_CASE("no exception of a controller gets out, whatever it is and wherever it comes from") {
  dmrp_world world{};
  check_outcomes("sample.controller", true, [&](const Sample& s) { return s.c.start(s.c.self, &world, 1); });
  const Path path = path_along_x(2);
  const dmrp_path c_path = path.c();
  check_outcomes("sample.controller", false,
                 [&](const Sample& s) { return s.as<dmrp_local_controller>().set_path(s.c.self, &c_path, 1); });
  const Scene scene;
  check_outcomes("sample.controller", true, [&](const Sample& s) {
    dmrp_command command{};
    command.struct_size = sizeof(command);
    return s.as<dmrp_local_controller>().step(s.c.self, &scene.observation, &command);
  });
}

TEST_CASE("a controller sees its path and observation, and its command comes back") {
  const Sample sample("sample.controller", "nothing");
  const auto& table = sample.as<dmrp_local_controller>();
  CHECK(table.struct_size == sizeof(dmrp_local_controller));

  const Path path = path_along_x(3);
  const dmrp_path c_path = path.c();
  REQUIRE(table.set_path(sample.c.self, &c_path, 6) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{6.0, 0.0, 1.0, 2.0});

  const Scene scene;
  // a newer host: the plugin must not write the additional fields of its command
  Longer<dmrp_command> command{};
  command.known.struct_size = sizeof(command);
  REQUIRE(table.step(sample.c.self, &scene.observation, &command.known) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{3.0, 0.8, 0.25, 1.5, 11.0, 12.0, 13.0});
  CHECK(command.known.v_x == 0.5);
  CHECK(command.known.v_y == 0.0);
  CHECK(command.known.omega == -0.25);
  CHECK(command.known.struct_size == sizeof(command));
  CHECK(command.unknown == 0x5555555555555555u);
}

TEST_CASE("log, should_stop and extensions go through the instance's own host") {
  Sample sample("sample.controller", "ask");
  const Sample other("sample.controller", "ask");
  const Scene scene;
  dmrp_command command{};
  command.struct_size = sizeof(command);
  sample.host.stop = 1;
  sample.as<dmrp_local_controller>().step(sample.c.self, &scene.observation, &command);
  CHECK(sample.host.asked_extension == "dmrp.lidar/1");
  CHECK(sample.host.log == std::vector<std::string>{std::to_string(DMRP_LOG_WARNING) + " asked to stop",
                                                    std::to_string(DMRP_LOG_DEBUG) + " 17"});
  CHECK(other.host.log.empty());

  REQUIRE(sample.c.get_extension != nullptr);
  const void* offered = sample.c.get_extension(sample.c.self, "sample/1");
  REQUIRE(offered != nullptr);
  CHECK(*static_cast<const int*>(offered) == 5);
  CHECK(sample.c.get_extension(sample.c.self, "sample/2") == nullptr);
}

TEST_CASE("a planner reads the problem by its strides and writes into the sink") {
  struct Sink {
    std::vector<std::vector<double>> paths;
    std::vector<std::string> statistics;
    std::int32_t answer = DMRP_OK;
  } got;
  dmrp_plan_sink sink{};
  sink.struct_size = sizeof(sink);
  sink.context = &got;
  sink.path = [](dmrp_plan_sink* self, std::uint32_t robot, const dmrp_waypoint* waypoints, std::uint32_t count,
                 std::uint32_t stride) {
    auto& to = *static_cast<Sink*>(self->context);
    to.paths.push_back({static_cast<double>(robot)});
    for (std::uint32_t i = 0; i < count; ++i)
      to.paths.back().push_back(DMRP_AT(dmrp_waypoint, waypoints, stride, i)->x);
    return to.answer;
  };
  sink.statistic = [](dmrp_plan_sink* self, const char* name, double value) {
    static_cast<Sink*>(self->context)->statistics.push_back(name + std::string("=") + std::to_string(value));
  };

  std::vector<Longer<dmrp_goal>> goals(2);
  goals[0].known.pose.x = 5.0;
  goals[1].known.pose.x = 6.0;
  std::vector<Longer<dmrp_planning_robot>> robots(2);
  for (std::size_t i = 0; i < 2; ++i) {
    robots[i].known.goals = &goals.front().known;
    robots[i].known.goal_stride = sizeof(goals.front());
    robots[i].known.goal_count = static_cast<std::uint32_t>(2 - i);
    robots[i].known.start = {static_cast<double>(i), 0.0};
  }
  dmrp_grid grid{};
  grid.width = 7;
  dmrp_planning_problem problem{};
  problem.struct_size = sizeof(problem);
  problem.grid = &grid;
  problem.robots = &robots.front().known;
  problem.robot_count = 2;
  problem.robot_stride = sizeof(robots.front());
  const auto plan = [&](const Sample& s) { return s.as<dmrp_global_planner>().plan(s.c.self, &problem, &sink); };

  check_outcomes("sample.planner", true, plan);
  got = {};
  const Sample sample("sample.planner", "nothing");
  REQUIRE(plan(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{7.0, 0.0});
  CHECK(got.paths == std::vector<std::vector<double>>{{0.0, 0.0, 5.0, 6.0}, {1.0, 1.0, 5.0}});
  CHECK(got.statistics == std::vector<std::string>{"cost=3.000000"});

  got.answer = DMRP_ERROR;
  CHECK(plan(sample) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused the path of robot 0");
}

TEST_CASE("a pedestrian model gives a velocity to each person and writes no further") {
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
  std::vector<dmrp_vec2> velocities(4, {-1.0, -1.0});
  const auto step = [&](const Sample& s) {
    return s.as<dmrp_pedestrian_model>().step(s.c.self, &crowd, velocities.data());
  };

  check_outcomes("sample.pedestrian", true, step);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(velocities[i].x == 20.0 + static_cast<double>(i));
    CHECK(velocities[i].y == 2.0);
  }
  CHECK(velocities[3].x == -1.0);
}

TEST_CASE("a metric sees plan, samples and end, and its values reach the sink as given") {
  struct Sink {
    std::vector<std::string> said;
    std::int32_t answer = DMRP_OK;
  } got;
  dmrp_metric_sink sink{};
  sink.struct_size = sizeof(sink);
  sink.context = &got;
  sink.value = [](dmrp_metric_sink* self, const char* name, std::uint32_t kind, std::uint64_t subject,
                  double coordinate, double value) {
    auto& to = *static_cast<Sink*>(self->context);
    const auto text = [](double x) { return std::isnan(x) ? std::string("-") : std::to_string(std::lround(10.0 * x)); };
    to.said.push_back(std::string(name) + " " + std::to_string(kind) + " " + std::to_string(subject) + " " +
                      text(coordinate) + " " + text(value));
    return to.answer;
  };
  sink.event = [](dmrp_metric_sink* self, const char* name, std::int64_t from, std::int64_t to_ns,
                  const std::uint32_t* robots, std::uint32_t count, const char* text) {
    auto& to = *static_cast<Sink*>(self->context);
    to.said.push_back(std::string(name) + " " + std::to_string(from) + ".." + std::to_string(to_ns) + " " +
                      std::to_string(count) + ":" + std::to_string(robots[count - 1]) + " " + text);
    return to.answer;
  };

  const Path first = path_along_x(2);
  const Path second = path_along_x(4);
  std::vector<Longer<dmrp_path>> paths = {{first.c()}, {second.c()}};
  dmrp_plan plan{};
  plan.struct_size = sizeof(plan);
  plan.path_count = 2;
  plan.paths = &paths.front().known;
  plan.path_stride = sizeof(paths.front());
  dmrp_metric_trial trial = {sizeof(trial), 0, &plan};

  std::vector<Longer<dmrp_robot_sample>> robots(2);
  robots[0].known.pose.x = 1.0;
  robots[1].known.pose.x = 2.0;
  std::vector<Longer<dmrp_person>> people(1);
  people[0].known.position.x = 3.0;
  std::vector<Longer<dmrp_contact>> contacts(1);
  contacts[0].known.depth_m = 0.5;
  std::vector<Longer<dmrp_call>> calls(2);
  calls[1].known.duration_ns = 77;
  dmrp_sample observed{};
  observed.struct_size = sizeof(observed);
  observed.control_tick = 1;
  observed.robots = &robots.front().known;
  observed.robot_count = 2;
  observed.robot_stride = sizeof(robots.front());
  observed.people = &people.front().known;
  observed.person_count = 1;
  observed.person_stride = sizeof(people.front());
  observed.contacts = &contacts.front().known;
  observed.contact_count = 1;
  observed.contact_stride = sizeof(contacts.front());
  observed.calls = &calls.front().known;
  observed.call_count = 2;
  observed.call_stride = sizeof(calls.front());

  std::vector<Longer<dmrp_robot_end>> ends(2);
  const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_ARRIVED, 3'000'000'000, &ends.front().known,
                              2,           sizeof(ends.front())};

  const auto begin = [&](const Sample& s) { return s.as<dmrp_metric>().begin(s.c.self, &trial); };
  const auto observe = [&](const Sample& s) { return s.as<dmrp_metric>().observe(s.c.self, &observed); };
  const auto finish = [&](const Sample& s) { return s.as<dmrp_metric>().finish(s.c.self, &end, &sink); };
  check_outcomes("sample.metric", false, begin);
  check_outcomes("sample.metric", false, observe);
  check_outcomes("sample.metric", false, finish);

  const Sample sample("sample.metric", "nothing");
  REQUIRE(begin(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{4.0});
  REQUIRE(observe(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{1.0, 1.0, 2.0, 3.0, 0.5, 0.0, 77.0});
  got = {};
  REQUIRE(finish(sample) == DMRP_OK);
  CHECK(got.said == std::vector<std::string>{"plain 0 0 - 30", "timed 1 1 - -", "curved 2 12 - 10", "curved 0 0 5 20",
                                             "plain 1..2 2:3 an event"});

  trial.plan = nullptr;  // planning failed
  REQUIRE(begin(sample) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{-1.0});

  got.answer = DMRP_ERROR;
  CHECK(finish(sample) == DMRP_ERROR);
  CHECK(sample.host.error == "the host refused a value of plain");
}
