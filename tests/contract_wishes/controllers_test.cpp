// SPDX-License-Identifier: MIT
// Lifelong goals, a learned policy, robots of every drive, one controller for all, velocities at waypoints, and messages.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/contract_wishes/driver.hpp"
#include "tests/contract_wishes/plugins/messages.h"
#include "tests/contract_wishes/plugins/waypoint_with_velocity.h"

using namespace dmrp::test;

namespace {

constexpr double dt_s = 0.1;

dmrp_command step(const Instance& controller, Scene& scene) {
  auto command = longer_output<dmrp_command>();
  REQUIRE(controller.as<dmrp_local_controller>().step(controller.c.self, scene.c(), &command.known) == DMRP_OK);
  CHECK(command.unknown == 0x5555555555555555u);
  return command.known;
}

// Moves the robot as the command says, and its progress along the straight from (0, 0) to (length_m, 0).
void drive(Scene& scene, const dmrp_command& command, double length_m) {
  dmrp_observation& now = scene.observation.known;
  now.pose.x += dt_s * (command.v_x * std::cos(now.pose.theta) - command.v_y * std::sin(now.pose.theta));
  now.pose.y += dt_s * (command.v_x * std::sin(now.pose.theta) + command.v_y * std::cos(now.pose.theta));
  now.pose.theta = std::remainder(now.pose.theta + dt_s * command.omega, 6.28318530717958647692);
  now.t_ns += now.dt_ns;
  now.progress_m = std::clamp(now.pose.x, now.progress_m, std::max(now.progress_m, length_m));
  now.progress_waypoint = static_cast<std::uint32_t>(now.progress_m);
}

std::vector<dmrp_vec2> straight(int length_m) {
  std::vector<dmrp_vec2> points;
  for (int x = 0; x <= length_m; ++x) points.push_back({1.0 * x, 0.0});
  return points;
}

World& open_world(std::size_t robots) {
  static std::vector<std::unique_ptr<World>> worlds;
  worlds.push_back(std::make_unique<World>(std::vector<std::string>{"..........", ".........."}, robots));
  return *worlds.back();
}

}  // namespace

TEST_CASE("a controller drives through a goal after which there is another, and on when it is sent on") {
  Library library(LIFELONG_CONTROLLER);
  Instance controller(library);
  World& world = open_world(1);
  REQUIRE(controller.start(world, 0) == DMRP_OK);
  REQUIRE(controller.set_path(0, straight(2)) == DMRP_OK);
  Scene scene(world.robot_data[0]);
  scene.goal = goal_at({2.0, 0.0});
  scene.observation.known.pose.x = 1.9;
  scene.observation.known.progress_m = 1.9;

  const double to_the_last = step(controller, scene).v_x;
  CHECK(to_the_last > 0.0);
  CHECK(to_the_last < 0.4);  // it brakes

  // arrived, and parked for a while; then a new goal, first without a path
  scene.observation.known.pose.x = 2.0;
  scene.observation.known.progress_m = 2.0;
  CHECK(step(controller, scene).v_x == Approx(0.0).margin(1e-9));
  scene.observation.known.goal_index = 1;
  scene.observation.known.goal_count = 2;
  scene.goal = goal_at({6.0, 0.0});
  CHECK(step(controller, scene).v_x == 0.0);
  REQUIRE(controller.set_path(0, {{2.0, 0.0}, {4.0, 0.0}, {6.0, 0.0}}, 1) == DMRP_OK);
  scene.observation.known.progress_m = 0.0;
  CHECK(step(controller, scene).v_x > 0.9);
}

TEST_CASE("a learned policy reads its weights once, beside the library, and all robots share them") {
  Library library(LEARNED_POLICY);
  REQUIRE(library.initialised == DMRP_OK);
  CHECK(library.host.log == std::vector<std::string>{"weights read"});
  World& world = open_world(2);
  Instance first(library), second(library);
  for (Instance* controller : {&first, &second}) {
    REQUIRE(controller->start(world, 0) == DMRP_OK);
    REQUIRE(controller->set_path(0, straight(4)) == DMRP_OK);
    Scene scene(world.robot_data[0]);
    scene.observation.known.pose.theta = 1.0;
    for (int i = 0; i < 200; ++i) drive(scene, step(*controller, scene), 4.0);
    CHECK(scene.observation.known.pose.x == Approx(4.0).margin(0.2));
    CHECK(scene.observation.known.pose.y == Approx(0.0).margin(0.2));
  }
  CHECK(library.host.log.size() == 1);
}

TEST_CASE("a library without its weights says which file it misses") {
  const auto folder = std::filesystem::temp_directory_path() / ("dmrp_no_weights_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const auto copy = folder / "liblearned.so";
  std::filesystem::copy_file(LEARNED_POLICY, copy, std::filesystem::copy_options::overwrite_existing);
  {
    const Library library(copy.string());
    CHECK(library.initialised == DMRP_ERROR);
    CHECK(library.host.error == (folder / "learned_policy.weights").string() + ": 17 weights are expected");
  }
  std::filesystem::remove_all(folder);
}

TEST_CASE("a controller drives each robot within what its kinematics allow") {
  Library library(ANY_DRIVE);
  CHECK(static_cast<const dmrp_controller_traits*>(library.descriptor().traits)->kinematics ==
        (1u << DMRP_KINEMATICS_DIFFERENTIAL | 1u << DMRP_KINEMATICS_HOLONOMIC | 1u << DMRP_KINEMATICS_ACKERMANN));
  World& world = open_world(3);
  world.robots[1].known.kinematics = DMRP_KINEMATICS_HOLONOMIC;
  world.robot_data[1].limits.v_y_max = 0.5;
  world.robots[2].known.kinematics = DMRP_KINEMATICS_ACKERMANN;
  dmrp_limits& car = world.robot_data[2].limits;
  car.v_min = -0.5;
  car.wheelbase_m = 0.6;
  car.steering_max = 0.5;
  car.steering_rate_max = 1.0;

  for (int robot = 0; robot < 3; ++robot) {
    CAPTURE(robot);
    Instance controller(library);
    REQUIRE(controller.start(world, robot) == DMRP_OK);
    REQUIRE(controller.set_path(static_cast<std::uint32_t>(robot), straight(6)) == DMRP_OK);
    Scene scene(world.robot_data[static_cast<std::size_t>(robot)]);
    scene.goal = goal_at({6.0, 0.0});
    scene.goal.pose.theta = 1.5;
    scene.observation.known.pose = {0.0, 0.4, -0.5};
    double steering = 0.0;
    double most_aside = 0.0;
    for (int i = 0; i < 300; ++i) {
      const dmrp_command command = step(controller, scene);
      most_aside = std::max(most_aside, std::abs(command.v_y));
      if (robot == 2 && std::abs(command.v_x) > 1e-6) {
        const double angle = std::atan(command.omega * car.wheelbase_m / command.v_x);
        CHECK(std::abs(angle) <= car.steering_max + 1e-9);
        CHECK(std::abs(angle - steering) <= car.steering_rate_max * dt_s + 1e-9);
        steering = i == 20 ? -0.3 : angle;  // a stone turns the wheels: the controller goes by what is measured
        scene.observation.known.steering_angle = steering;
      }
      drive(scene, command, 6.0);
    }
    CHECK(scene.observation.known.pose.x == Approx(6.0).margin(0.2));
    CHECK(scene.observation.known.pose.y == Approx(0.0).margin(0.2));
    CHECK((most_aside > 0.0) == (robot == 1));
    CHECK(most_aside <= 0.5);
    if (robot == 1) CHECK(scene.observation.known.pose.theta == Approx(1.5).margin(0.1));
  }
}

TEST_CASE("a controller keeps the room that its footprint's parts need") {
  Library library(ANY_DRIVE);
  World& world = open_world(1);
  const dmrp_vec2 body[] = {{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}};
  const dmrp_vec2 arm[] = {{0.3, -0.1}, {1.0, -0.1}, {1.0, 0.1}, {0.3, 0.1}};
  const std::vector<Longer<dmrp_polygon>> parts = {{{body, 4, 0}}, {{arm, 4, 0}}};

  const auto stops_at = [&](std::uint32_t part_count) {
    world.robot_data[0].footprint = {sizeof(dmrp_footprint), part_count, 1.1, 0.2, &parts.front().known,
                                     sizeof(parts.front()),  0};
    if (part_count == 0) world.robot_data[0].footprint.radius_m = 0.2;
    Instance controller(library);
    REQUIRE(controller.start(world, 0) == DMRP_OK);
    REQUIRE(controller.set_path(0, straight(6)) == DMRP_OK);
    Scene scene(world.robot_data[0]);
    scene.goal = goal_at({6.0, 0.0});
    dmrp_agent person{};
    person.kind = DMRP_AGENT_PERSON;
    person.pose = {4.0, 0.0, 0.0};
    person.radius_m = 0.3;
    scene.agents = {{person}};
    for (int i = 0; i < 300; ++i) drive(scene, step(controller, scene), 6.0);
    return scene.observation.known.pose.x;
  };
  CHECK(stops_at(0) == Approx(4.0 - 0.3 - 0.2 - 0.2).margin(0.05));
  CHECK(stops_at(1) == Approx(4.0 - 0.3 - 0.3 - 0.2).margin(0.05));
  CHECK(stops_at(2) == Approx(4.0 - 0.3 - 1.0 - 0.2).margin(0.05));  // the arm
}

TEST_CASE("one controller for all robots lets one of those near each other pass at a time") {
  Library library(ONE_AT_A_TIME);
  CHECK((library.descriptor().flags & DMRP_FLAG_CENTRAL) != 0);
  World& world = open_world(3);
  Instance controller(library);
  REQUIRE(controller.start(world) == DMRP_OK);
  for (std::uint32_t robot = 0; robot < 3; ++robot) REQUIRE(controller.set_path(robot, straight(6)) == DMRP_OK);
  const auto& table = controller.as<dmrp_local_controller>();
  REQUIRE(table.step == nullptr);
  REQUIRE(table.step_all != nullptr);

  Scene scene(world.robot_data[0]);
  scene.goal = goal_at({6.0, 0.0});
  // drives those of `robots`, at these x
  const auto speeds = [&](const std::vector<std::uint32_t>& robots, const std::vector<double>& x) {
    std::vector<Longer<dmrp_observation>> observations;
    std::vector<Longer<dmrp_command>> commands(robots.size(), longer_output<dmrp_command>());
    for (std::size_t i = 0; i < robots.size(); ++i) {
      scene.observation.known.robot = robots[i];
      scene.observation.known.pose.x = x[i];
      scene.observation.known.progress_m = x[i];
      observations.push_back({*scene.c()});
    }
    const dmrp_fleet fleet = {sizeof(fleet),
                              count_of(observations),
                              &observations.front().known,
                              sizeof(observations.front()),
                              sizeof(commands.front()),
                              &commands.front().known};
    REQUIRE(table.step_all(controller.c.self, &fleet) == DMRP_OK);
    std::vector<bool> moves;
    for (const auto& command : commands) {
      CHECK(command.known.status == DMRP_OK);
      CHECK(command.unknown == 0x5555555555555555u);
      moves.push_back(command.known.v_x > 0.0);
    }
    return moves;
  };
  CHECK(speeds({0, 1, 2}, {0.0, 1.0, 2.0}) == std::vector<bool>{true, false, true});  // 2 is far from 0, 1 waits
  CHECK(speeds({0, 1, 2}, {0.0, 3.0, 5.0}) == std::vector<bool>{true, true, true});
  CHECK(speeds({1, 2}, {1.0, 2.0}) == std::vector<bool>{true, false});  // 0 has finished: it is not in the fleet
  CHECK(speeds({0, 1, 2}, {1.5, 1.0, 2.0}) == std::vector<bool>{true, false, false});  // and has been sent on
}

TEST_CASE("a controller uses the velocities at waypoints where the host gives them") {
  Library library(KINODYNAMIC_FOLLOWER);
  World& world = open_world(1);
  Instance controller(library);
  REQUIRE(controller.start(world, 0) == DMRP_OK);
  Scene scene(world.robot_data[0]);
  scene.goal = goal_at({3.0, 0.0});

  std::vector<waypoint_with_velocity> waypoints;
  for (int i = 0; i <= 3; ++i)
    waypoints.push_back({{1.0 * i, 0.0, 0.0, std::int64_t{i} * 2'000'000'000, 0, 0}, i == 3 ? 0.0 : 0.3 * i});
  dmrp_path path = {sizeof(path), 4, sizeof(waypoints.front()), 0, &waypoints.front().known};
  dmrp_path_update update = {sizeof(update), 0, 1, &path, 0, 0};
  const auto& table = controller.as<dmrp_local_controller>();
  REQUIRE(table.set_path(controller.c.self, &update) == DMRP_OK);
  CHECK(step(controller, scene).v_x == Approx(0.3));  // at the next waypoint

  // a host that does not know the field: the same waypoints without it
  std::vector<dmrp_waypoint> shorter;
  for (const auto& waypoint : waypoints) shorter.push_back(waypoint.known);
  path.stride = sizeof(shorter.front());
  path.waypoints = shorter.data();
  update.revision = 2;
  REQUIRE(table.set_path(controller.c.self, &update) == DMRP_OK);
  CHECK(step(controller, scene).v_x == Approx(0.5));  // 1 m in 2 s
}

namespace {

// A host that carries messages between the robots of a trial.
struct Post {
  std::vector<std::vector<Longer<draft_message>>> arrived;
  std::vector<double> data;
  draft_inbox inbox{};
  draft_messages c{};

  explicit Post(std::size_t robots) : arrived(robots) {
    data.reserve(1000);
    c = {sizeof(c), 0, this,
         [](const draft_messages* self, std::uint32_t from, const void* text, std::uint32_t size) {
           auto& post = *static_cast<Post*>(self->context);
           post.data.emplace_back();
           std::memcpy(&post.data.back(), text, std::min<std::size_t>(size, sizeof(double)));
           for (std::size_t to = 0; to < post.arrived.size(); ++to)
             if (to != from) post.arrived[to].push_back({{from, size, 0, &post.data.back()}});
           return std::int32_t{DMRP_OK};
         },
         [](const draft_messages* self, std::uint32_t robot) -> const draft_inbox* {
           auto& post = *static_cast<Post*>(self->context);
           const auto& messages = post.arrived[robot];
           post.inbox = {sizeof(post.inbox), count_of(messages), sizeof(Longer<draft_message>), 0,
                         messages.empty() ? nullptr : &messages.front().known};
           return &post.inbox;
         }};
  }
  Post(const Post&) = delete;
  Post& operator=(const Post&) = delete;
};

// Two robots face each other, robot 1 with the longer way: who moves in their third period?
std::pair<bool, bool> who_moves(const void* messages) {
  Library library(MESSAGES);
  World& world = open_world(2);
  Instance first(library), second(library);
  std::pair<bool, bool> moves;
  std::uint32_t robot = 0;
  for (Instance* controller : {&first, &second}) {
    if (messages) controller->host.offers[DRAFT_MESSAGES] = messages;
    REQUIRE(controller->start(world, static_cast<std::int32_t>(robot)) == DMRP_OK);
    REQUIRE(controller->set_path(robot, straight(robot == 0 ? 3 : 6)) == DMRP_OK);
    ++robot;
  }
  for (int period = 0; period < 3; ++period) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      Scene scene(world.robot_data[i]);
      scene.observation.known.robot = i;
      dmrp_agent other{};
      other.id = 1 - i;
      other.kind = DMRP_AGENT_ROBOT;
      other.pose = {1.0, 0.0, 0.0};
      scene.agents = {{other}};
      (i == 0 ? moves.first : moves.second) = step(i == 0 ? first : second, scene).v_x > 0.0;
    }
  }
  return moves;
}

}  // namespace

TEST_CASE("robots agree by messages, and do without them where the host has none") {
  const Post post(2);
  CHECK(who_moves(&post.c) == std::pair(false, true));  // the longer way goes first
  CHECK(who_moves(nullptr) == std::pair(true, false));  // the lower id
}
