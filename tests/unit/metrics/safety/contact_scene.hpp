// SPDX-License-Identifier: MIT
// contact_scene.hpp: a robot and another body in a small world: read from contact_scenes.txt, run by core's world,
// judged by the metrics.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"
#include "tests/unit/metrics/synthetic_trial.hpp"

namespace dmrp::test {

struct SceneCommand {
  double t_s;
  double v;      // m/s
  double omega;  // rad/s
};

struct SceneRobot {
  std::string type;  // "" or "transporter"
  dmrp_pose start{};
  std::vector<SceneCommand> commands;
};

struct ContactScene {
  std::size_t line = 0;
  std::string kind, set, verdict, reason;
  SceneRobot robot;
  std::optional<SceneRobot> other;
  core::Track person;  // without points: none
  std::vector<std::array<double, 4>> walls;
};

enum class TrialLength { to_first_contact, whole };

namespace detail {

constexpr dmrp_vec2 scene_origin{30.0, 30.0};

inline std::vector<double> numbers_of(std::string text) {
  for (char& one : text)
    if (one == ',' || one == ':' || one == '@') one = ' ';
  std::istringstream in(text);
  std::vector<double> numbers;
  for (double number; in >> number;) numbers.push_back(number);
  return numbers;
}

inline SceneRobot scene_robot(std::istringstream& in) {
  SceneRobot robot{"", {scene_origin.x, scene_origin.y, 0.0}, {}};
  for (std::string word; in >> word;) {
    const std::vector<double> numbers = numbers_of(word);
    if (word == "transporter")
      robot.type = word;
    else if (word.front() == '@')
      robot.start = {scene_origin.x + numbers.at(0), scene_origin.y + numbers.at(1),
                     numbers.at(2) * std::numbers::pi / 180.0};
    else
      robot.commands.push_back({numbers.at(0), numbers.at(1), numbers.size() > 2 ? numbers[2] : 0.0});
  }
  return robot;
}

inline ContactScene scene_of(const std::string& text, std::size_t line) {
  std::vector<std::string> fields;
  std::istringstream columns(text);
  for (std::string field; std::getline(columns, field, '|');) {
    const auto from = field.find_first_not_of(' ');
    fields.push_back(field.substr(from, field.find_last_not_of(' ') + 1 - from));
  }
  if (fields.size() != 7) throw std::runtime_error("line " + std::to_string(line) + ": seven columns expected");
  ContactScene scene;
  scene.line = line;
  scene.kind = fields[0];
  scene.set = fields[1];
  std::istringstream robot(fields[2]), other(fields[3]), walls(fields[4]);
  scene.robot = scene_robot(robot);
  std::string word;
  other >> word;
  if (word == "robot") scene.other = scene_robot(other);
  while (word == "person" && other >> fields[3]) {
    const std::vector<double> numbers = numbers_of(fields[3]);
    scene.person.points.push_back(
        {nanoseconds(numbers.at(2)), {scene_origin.x + numbers.at(0), scene_origin.y + numbers.at(1)}});
  }
  while (walls >> word && word != "-") {
    const std::vector<double> n = numbers_of(word);
    scene.walls.push_back({n.at(0), n.at(1), n.at(2), n.at(3)});
  }
  scene.verdict = fields[5];
  scene.reason = fields[6];
  return scene;
}

}  // namespace detail

inline std::vector<ContactScene> read_contact_scenes(const std::string& path) {
  std::ifstream file(path);
  std::vector<ContactScene> scenes;
  std::size_t line = 0;
  for (std::string text; std::getline(file, text);) {
    ++line;
    if (!text.empty() && text.front() != '#') scenes.push_back(detail::scene_of(text, line));
  }
  return scenes;
}

inline core::World world_of(const ContactScene& scene) {
  core::Scenario scenario = core::test::empty_scenario(60.0, 60.0);
  for (const auto& wall : scene.walls)
    scenario.shapes.push_back(core::test::box("wall", detail::scene_origin + dmrp_vec2{wall[0], wall[1]},
                                              detail::scene_origin + dmrp_vec2{wall[2], wall[3]}));
  const auto add = [&](const SceneRobot& robot) {
    scenario.robots.push_back({"robot", robot.start, {{1.0, 1.0, 0.0}}, robot.type});
  };
  add(scene.robot);
  if (scene.other) add(*scene.other);
  if (!scene.person.points.empty()) scenario.tracks.push_back(scene.person);
  core::RobotTypes types;
  core::RobotSettings transporter;
  transporter.type = "transporter";
  transporter.parts = {{{-0.6, -0.3}, {0.6, -0.3}, {0.6, 0.3}, {-0.6, 0.3}}};
  transporter.radius_m = std::hypot(0.6, 0.3);
  types.put(transporter);
  return core::World(scenario, types, core::SimulationSettings{}, core::test::geometry_of(scenario), 1);
}

inline void record(const core::World& world, SyntheticTrial& trial) {
  std::vector<dmrp_robot_sample> robots;
  for (const core::RobotState& robot : world.robots())
    robots.push_back({robot.pose, robot.velocity, robot.command, robot.state, 0, 0.0, 0.0, robot.command, DMRP_OK, 0});
  trial.sample(1e-9 * static_cast<double>(world.t_ns()), robots);
  trial.crowd({world.people().begin(), world.people().end()});
  trial.contacts({world.contacts().begin(), world.contacts().end()});
}

// At most 9 s, or until shortly after the first contact.
inline SyntheticTrial trial_of(const ContactScene& scene, TrialLength length) {
  core::World world = world_of(scene);
  SyntheticTrial trial(world.robots().size());
  trial.bounds({0.0, 0.0}, {60.0, 60.0});
  if (!scene.robot.type.empty()) trial.robot_rectangle(0.6, 0.3);
  for (const auto& wall : scene.walls)
    trial.box("wall", detail::scene_origin + dmrp_vec2{wall[0], wall[1]},
              detail::scene_origin + dmrp_vec2{wall[2], wall[3]});
  const auto command = [&](std::uint32_t index, const SceneRobot& robot) {
    for (const SceneCommand& one : robot.commands)
      if (nanoseconds(one.t_s) == world.t_ns()) world.set_command(index, {one.v, 0.0, one.omega});
  };
  record(world, trial);
  std::int64_t end_ns = 9'000'000'000;
  while (world.t_ns() < end_ns) {
    command(0, scene.robot);
    if (scene.other) command(1, *scene.other);
    world.step(std::vector<dmrp_vec2>(world.people().size()));
    record(world, trial);
    if (length == TrialLength::to_first_contact && !world.contacts().empty())
      end_ns = std::min(end_ns, world.t_ns() + 100'000'000);
  }
  trial.end(1e-9 * static_cast<double>(end_ns));
  return trial;
}

// "1" or "0" for each of contact_free_success, safe_success, braking_response_success of the robot.
inline std::string judge(const ContactScene& scene, const ParamOverrides& braking_response = {}) {
  const SyntheticTrial trial = trial_of(scene, TrialLength::to_first_contact);
  const Measurement success = measure("dmrp.metric.success", trial);
  const Measurement braking = measure("dmrp.metric.braking_response", trial, braking_response);
  std::string verdict;
  for (const double value : {success.robot("contact_free_success", 0), success.robot("safe_success", 0),
                             braking.robot("braking_response_success", 0)})
    verdict += value == 1.0 ? '1' : '0';
  return verdict;
}

}  // namespace dmrp::test
