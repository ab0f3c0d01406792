// SPDX-License-Identifier: MIT
// Controllers, for one robot and for all, called as a host calls them: arguments, results and errors.
#include <catch2/catch.hpp>
#include <dmrp/plugin.hpp>
#include <string>
#include <vector>

#include "tests/conformance/calls.hpp"

using namespace dmrp::test;

namespace {

struct Scene {
  dmrp_limits limits{};
  dmrp_vec2 corners[3] = {{0.5, 0.0}, {0.0, 0.5}, {-0.5, -0.5}};
  std::vector<Longer<dmrp_polygon>> parts = {{{corners, 3, 0}}, {{corners + 1, 2, 0}}};
  dmrp_footprint footprint{};
  dmrp_goal goal{};
  std::vector<Longer<dmrp_agent>> agents;
  dmrp_observation observation{};

  Scene() {
    limits.struct_size = sizeof(limits);
    limits.v_max = 0.8;
    footprint = {sizeof(footprint), 2, 0.25, 0.1, &parts.front().known, sizeof(parts.front()), 0};
    goal.pose.x = 9.0;
    for (std::uint64_t id : {11u, 12u, 13u}) agents.push_back({{id, DMRP_AGENT_PERSON, 0, {}, {}, 0.3}});
    observation.struct_size = sizeof(observation);
    observation.t_ns = 1'500'000'000;
    observation.pose = {3.0, 4.0, 0.0};
    observation.goal = &goal;
    observation.limits = &limits;
    observation.footprint = &footprint;
    observation.agents = &agents.front().known;
    observation.agent_count = count_of(agents);
    observation.agent_stride = sizeof(Longer<dmrp_agent>);
    observation.steering_angle = 0.125;
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

// Three active robots, 2, 5 and 7, with observations and commands of a newer host.
struct Fleet {
  Scene scene;
  std::vector<Longer<dmrp_observation>> observations;
  std::vector<Longer<dmrp_command>> commands;
  dmrp_fleet c{};

  Fleet() {
    for (std::uint32_t robot : {2u, 5u, 7u}) {
      observations.push_back({scene.observation});
      observations.back().known.robot = robot;
      observations.back().known.pose.x = 0.5 * robot;
      commands.push_back(longer_output<dmrp_command>());
    }
    c = {sizeof(c),
         count_of(observations),
         &observations.front().known,
         sizeof(observations.front()),
         sizeof(commands.front()),
         &commands.front().known};
  }
};

}  // namespace

TEST_CASE("no exception of a controller gets out, whatever it is and wherever it comes from") {
  check_outcomes("sample.controller", true, [&](const Sample& s) { return s.start(); });
  const PathAlongX path(2);
  const dmrp_path c_path = path.c();
  const dmrp_path_update update = {sizeof(update), 0, 1, &c_path, 0, 0};
  check_outcomes("sample.controller", false,
                 [&](const Sample& s) { return s.as<dmrp_local_controller>().set_path(s.c.self, &update); });
  const Scene scene;
  check_outcomes("sample.controller", true, [&](const Sample& s) {
    auto command = longer_output<dmrp_command>();
    return s.as<dmrp_local_controller>().step(s.c.self, &scene.observation, &command.known);
  });
  const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_ARRIVED, 0, nullptr, 0, 0};
  check_outcomes("sample.controller", false, [&](const Sample& s) { return s.c.trial_end(s.c.self, &end); });
}

TEST_CASE("a controller sees its path and observation, and its command comes back") {
  const Sample sample("sample.controller", "nothing");
  const auto& table = sample.as<dmrp_local_controller>();
  CHECK(table.struct_size == sizeof(dmrp_local_controller));
  CHECK(table.step_all == nullptr);

  const PathAlongX path(3);
  const dmrp_path c_path = path.c();
  const dmrp_path_update update = {sizeof(update), 4, 6, &c_path, 0, 0};
  REQUIRE(table.set_path(sample.c.self, &update) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{6.0, 0.0, 1.0, 2.0});
  CHECK(seen().texts == std::vector<std::string>{"whole", "is another"});

  const Scene scene;
  // a newer host: the plugin must not write the additional fields of its command
  auto command = longer_output<dmrp_command>();
  REQUIRE(table.step(sample.c.self, &scene.observation, &command.known) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{3.0, 0.8, 0.25, 1.5, 9.0, 0.125, 11.0, 12.0, 13.0, 0.5, 0.0});
  CHECK(command.known.v_x == 0.5);
  CHECK(command.known.v_y == 0.0);
  CHECK(command.known.omega == -0.25);
  CHECK(command.known.status == DMRP_OK);
  CHECK(command.known.struct_size == sizeof(command));
  CHECK(command.unknown == 0x5555555555555555u);
}

TEST_CASE("controllers hear that a path is partial, and that it continues the one before") {
  const PathAlongX path(3);
  dmrp_path c_path = path.c();
  for (const char* id : {"sample.controller", "sample.central"})
    for (const std::uint32_t path_flags : {0u, DMRP_PATH_PARTIAL, 0xfffffffeu})
      for (const std::uint32_t update_flags : {0u, DMRP_PATH_CONTINUES, 0xfffffffeu}) {  // others are of later versions
        const Sample sample(id, "nothing");
        c_path.flags = path_flags;
        const dmrp_path_update update = {sizeof(update), 0, 1, &c_path, update_flags, 0};
        REQUIRE(sample.as<dmrp_local_controller>().set_path(sample.c.self, &update) == DMRP_OK);
        CHECK(seen().texts ==
              std::vector<std::string>{path_flags == DMRP_PATH_PARTIAL ? "partial" : "whole",
                                       update_flags == DMRP_PATH_CONTINUES ? "continues" : "is another"});
      }
}

TEST_CASE("a plugin says that a trial is not for it") {
  CHECK(Sample("sample.controller", "unsupported").start() == DMRP_UNSUPPORTED);
}

TEST_CASE("a controller hears how its trial ended") {
  const Sample sample("sample.controller", "nothing");
  std::vector<Longer<dmrp_robot_end>> robots(2);
  const dmrp_trial_end end = {sizeof(end), DMRP_ENDING_DEADLOCK,  2'500'000'000, &robots.front().known,
                              2,           sizeof(robots.front())};
  REQUIRE(sample.c.trial_end != nullptr);
  CHECK(sample.c.trial_end(sample.c.self, &end) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{DMRP_ENDING_DEADLOCK, 2.5, 2.0});
}

TEST_CASE("log and should_stop go through the instance's own host") {
  Sample sample("sample.controller", "nothing");
  const Sample other("sample.controller", "nothing");
  const Scene scene;
  auto command = longer_output<dmrp_command>();
  sample.host.stop = 1;
  for (const Sample* s : {&other, static_cast<const Sample*>(&sample)})
    s->as<dmrp_local_controller>().step(s->c.self, &scene.observation, &command.known);
  CHECK(sample.host.log == std::vector<std::string>{std::to_string(DMRP_LOG_WARNING) + " asked to stop"});
  CHECK(other.host.log.empty());
}

TEST_CASE("no exception of a central controller gets out") {
  Fleet fleet;
  check_outcomes("sample.central", true,
                 [&](const Sample& s) { return s.as<dmrp_local_controller>().step_all(s.c.self, &fleet.c); });
  const PathAlongX path(2);
  const dmrp_path c_path = path.c();
  const dmrp_path_update update = {sizeof(update), 1, 1, &c_path, 0, 0};
  check_outcomes("sample.central", false,
                 [&](const Sample& s) { return s.as<dmrp_local_controller>().set_path(s.c.self, &update); });
}

TEST_CASE("a central controller drives each robot by its own observation") {
  const Sample sample("sample.central", "nothing");
  const auto& table = sample.as<dmrp_local_controller>();
  CHECK(table.step == nullptr);

  const PathAlongX path(5);
  const dmrp_path c_path = path.c();
  const dmrp_path_update update = {sizeof(update), 7, 2, &c_path, 0, 0};
  REQUIRE(table.set_path(sample.c.self, &update) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{7.0, 2.0, 4.0});

  Fleet fleet;
  REQUIRE(table.step_all(sample.c.self, &fleet.c) == DMRP_OK);
  CHECK(seen().numbers == std::vector<double>{2.0, 5.0, 7.0});
  const std::vector<double> expected_v_x = {1.0, 0.0, 3.5};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& command = fleet.commands[i];
    CHECK(command.known.v_x == expected_v_x[i]);
    CHECK(command.known.omega == (i == 1 ? 0.0 : -1.0));
    CHECK(command.known.v_y == (i == 1 ? 0.0 : 0.25));
    CHECK(command.known.status == (i == 1 ? DMRP_NO_SOLUTION : DMRP_OK));
    CHECK(command.known.struct_size == sizeof(command));
    CHECK(command.unknown == 0x5555555555555555u);
  }

  fleet.c.count = 0;  // all robots have finished for now
  CHECK(table.step_all(sample.c.self, &fleet.c) == DMRP_OK);
  CHECK(seen().numbers.empty());
}
