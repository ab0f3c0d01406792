// SPDX-License-Identifier: MIT
#include "core/execution/recovery.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "core/execution/clear_way.hpp"
#include "core/execution/referee.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace recovery_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double pi = std::numbers::pi;

using Steps = std::vector<RecoveryStep>;
using Controller = std::function<std::optional<dmrp_twist>(double t_s)>;

std::optional<dmrp_twist> standing(double) {
  return dmrp_twist{};
}

RobotSettings that_backs_up() {
  RobotSettings settings;
  settings.recovery_v_min = -0.2;
  return settings;
}

SimulationSettings with_ladder(const Steps& steps, std::uint32_t retries = 6) {
  SimulationSettings settings;
  settings.recovery.retries = retries;
  settings.recovery.steps = steps;
  return settings;
}

// A hall of 20 x 20 m with the first robot in its middle, headed east; its goal is far away.
Scenario hall() {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({10, 10, 0}, dmrp_vec2{18, 10})};
  return scenario;
}

// The first robot, driven by `controller` and the ladder at 10 Hz.
struct Trial {
  Trial(const Scenario& scenario, const RobotSettings& type, const SimulationSettings& settings,
        bool has_costmap = true)
      : geometry(geometry_of(scenario)),
        grids(*geometry, RobotTypes(type), {}),
        world(scenario, type, settings, geometry, 1),
        referee(world, grids, {}, 1),
        courses(world.robots().size()),
        ladder(world, std::vector<bool>(world.robots().size(), has_costmap)) {}

  void run(double until_s, const Controller& controller = standing, bool held = false) {
    for (; world.t_ns() < std::llround(until_s * 1e9); step()) {
      if (world.t_ns() % world.settings().control_period_ns != 0) continue;
      const double t_s = 1e-9 * static_cast<double>(world.t_ns());
      referee.judge_progress(courses);
      if (const auto action = ladder.act(0, referee.gained_m()[0], held)) {
        if (action->begins) {
          steps.push_back(*action->begins);
          begun_s.push_back(t_s);
        }
        world.set_recovery_command(0, action->command);
        recovered_s += 0.1;
        continue;
      }
      const auto command = controller(t_s);
      ladder.controller_answered(0, command.has_value());
      world.set_command(0, command.value_or(dmrp_twist{}));
    }
  }

  void step() {
    world.step(std::vector<dmrp_vec2>(world.people().size()));
    referee.command_given(0);
    referee.judge_arrivals(courses);
  }

  const RobotState& state() const { return world.robots()[0]; }

  std::shared_ptr<const StaticGeometry> geometry;
  PlanningGrids grids;
  World world;
  Referee referee;
  std::vector<CoursePlace> courses;
  RecoveryLadder ladder;
  Steps steps;                  // that began
  std::vector<double> begun_s;  // when
  double recovered_s = 0.0;     // in which the controller was not asked
};

TEST_CASE("a robot that gained no more than half a metre for ten seconds recovers") {
  Trial standing_still(hall(), {}, with_ladder({RecoveryStep::wait}));
  standing_still.run(10.05);
  CHECK(standing_still.steps.empty());
  standing_still.run(15.05);
  CHECK(standing_still.steps == Steps{RecoveryStep::wait});
  CHECK(standing_still.begun_s[0] == Approx(10.1));
  CHECK(standing_still.ladder.is_recovering(0));
  standing_still.run(15.15);
  CHECK_FALSE(standing_still.ladder.is_recovering(0));  // after five seconds
  CHECK(standing_still.recovered_s == Approx(5.0));

  Trial creeping(hall(), {}, with_ladder({RecoveryStep::wait}));
  creeping.run(60.0, [](double) { return dmrp_twist{0.06, 0.0, 0.0}; });
  CHECK(creeping.steps.empty());

  Trial turning(hall(), {}, with_ladder({RecoveryStep::wait}));
  turning.run(12.0, [](double) { return dmrp_twist{0.0, 0.0, 1.0}; });
  CHECK(turning.steps.size() == 1);

  Trial waiting_for_others(hall(), {}, with_ladder({RecoveryStep::wait}));
  waiting_for_others.run(60.0, &standing, true);
  CHECK(waiting_for_others.steps.empty());
}

TEST_CASE("without retries there is no recovery, and no more than there are") {
  Trial off(hall(), {}, with_ladder({RecoveryStep::wait}, 0));
  off.run(60.0);
  CHECK(off.steps.empty());
  Trial two(hall(), {}, with_ladder({RecoveryStep::wait}, 2));
  two.run(120.0);
  CHECK(two.steps.size() == 2);
}

TEST_CASE("each goal of a tour has its own retries") {
  Scenario scenario = hall();
  scenario.robots = {robot({10, 10, 0}, {{10.0, 10.0, any_heading}, {18.0, 10.0, any_heading}})};
  scenario.robots[0].goals[0].x = 10.1;
  Trial trial(scenario, {}, with_ladder({RecoveryStep::wait}, 1));
  // turns at the first goal for 12 s, too fast to have arrived, then waits there, and then at rest far from the second
  trial.run(60.0, [](double) { return dmrp_twist{}; });
  CHECK(trial.state().goal_index == 1);
  CHECK(trial.steps.size() == 1);
}

TEST_CASE("a controller without a command for longer than 0.3 s calls for a recovery") {
  Trial trial(hall(), {}, with_ladder({RecoveryStep::wait}));
  trial.run(30.0, [](double t_s) -> std::optional<dmrp_twist> {
    if (t_s > 1.95 && t_s < 2.25) return std::nullopt;  // three in a row are tolerated
    if (t_s > 3.95 && t_s < 9.0) return std::nullopt;
    return dmrp_twist{0.2, 0.0, 0.0};
  });
  REQUIRE(trial.steps.size() == 1);
  CHECK(trial.begun_s[0] == Approx(4.4));  // the last command was that of 3.9 s
}

TEST_CASE("recoveries take the steps in turn, and go on with the next where one fails") {
  const Steps all = {RecoveryStep::clear_costmap, RecoveryStep::spin, RecoveryStep::wait, RecoveryStep::backup,
                     RecoveryStep::replan};
  Trial able(hall(), that_backs_up(), with_ladder(all));
  able.run(120.0);
  Steps expected = all;
  expected.push_back(RecoveryStep::clear_costmap);
  CHECK(able.steps == expected);

  Trial unable(hall(), {}, with_ladder(all), false);  // no costmap, cannot drive backwards
  unable.run(80.0);
  CHECK(unable.steps == Steps{RecoveryStep::spin, RecoveryStep::wait, RecoveryStep::replan, RecoveryStep::spin,
                              RecoveryStep::wait, RecoveryStep::replan});

  Trial helpless(hall(), {}, with_ladder({RecoveryStep::backup}));
  helpless.run(80.0);
  CHECK(helpless.steps.empty());
  CHECK(helpless.recovered_s == 0.0);
}

TEST_CASE("spin turns a quarter to the left on the spot, and ends at rest") {
  Trial trial(hall(), {}, with_ladder({RecoveryStep::spin}, 1));
  trial.run(20.0);
  CHECK(trial.state().pose.theta >= 1.57);
  CHECK(trial.state().pose.theta < 1.70);
  CHECK(trial.state().pose.x == 10.0);
  CHECK(trial.recovered_s < 4.0);

  RobotSettings car;
  car.drive = Drive::ackermann;
  car.wheelbase_m = 0.4;
  Trial cannot(hall(), car, with_ladder({RecoveryStep::spin}));
  cannot.run(20.0);
  CHECK(cannot.steps.empty());
}

TEST_CASE("a robot with corners spins only where they have room") {
  RobotSettings box_robot;
  box_robot.parts = {{{-0.5, -0.2}, {0.5, -0.2}, {0.5, 0.2}, {-0.5, 0.2}}};
  box_robot.radius_m = std::hypot(0.5, 0.2);
  Trial free(hall(), box_robot, with_ladder({RecoveryStep::spin}, 1));
  free.run(20.0);
  CHECK(free.state().pose.theta >= 1.57);

  Scenario aisle = hall();
  aisle.shapes = {box("left", {5, 10.4}, {15, 11}), box("right", {5, 9}, {15, 9.6})};
  Trial narrow(aisle, box_robot, with_ladder({RecoveryStep::spin, RecoveryStep::wait}, 1));
  narrow.run(30.0);
  CHECK(std::abs(narrow.state().pose.theta) < 0.3);
  CHECK(narrow.world.contacts().empty());
  CHECK(narrow.steps.back() == RecoveryStep::wait);
}

TEST_CASE("backup drives 0.3 m backwards at 0.05 m/s, which nothing else may") {
  Trial trial(hall(), that_backs_up(), with_ladder({RecoveryStep::backup}, 1));
  double slowest = 0.0;
  trial.run(10.05);
  while (trial.world.t_ns() < 20'000'000'000) {
    trial.run(1e-9 * static_cast<double>(trial.world.t_ns()) + 0.1);
    slowest = std::min(slowest, trial.state().velocity.v_x);
  }
  CHECK(slowest == Approx(-0.05));
  CHECK(trial.state().pose.x == Approx(9.7).margin(0.01));
  CHECK(trial.state().pose.y == 10.0);
  CHECK(trial.state().velocity.v_x == 0.0);
  trial.run(22.0, [](double) { return dmrp_twist{-0.2, 0.0, 0.0}; });
  CHECK(trial.state().velocity.v_x == 0.0);

  RobotSettings slow = that_backs_up();
  slow.recovery_v_min = -0.035;
  Trial slower(hall(), slow, with_ladder({RecoveryStep::backup}, 1));
  slower.run(15.0);
  CHECK(slower.state().velocity.v_x == Approx(-0.035));
}

TEST_CASE("backup stops before what the robot senses, and not before what it cannot") {
  const auto after = [](const Scenario& scenario, const RobotSettings& type = that_backs_up()) {
    auto trial = std::make_unique<Trial>(scenario, type, with_ladder({RecoveryStep::backup, RecoveryStep::wait}, 1));
    trial->run(30.0);
    return trial;
  };
  Scenario wall = hall();
  wall.shapes = {box("wall", {9.0, 9}, {9.55, 11})};  // 0.2 m behind
  const double x_wall = after(wall)->state().pose.x;
  CHECK(x_wall < 9.97);
  CHECK(x_wall - 0.25 - 9.55 >= clear_gap_m);

  Scenario other = hall();
  other.robots.push_back(robot({9.3, 10, 0}, dmrp_vec2{2, 2}));  // 0.2 m behind
  const double x_robot = after(other)->state().pose.x;
  CHECK(x_robot < 9.97);
  CHECK(x_robot - 9.3 - 0.5 >= clear_gap_m);

  Scenario person = hall();  // 0.2 m behind, who stands
  person.tracks = {
      {{{0, {9.55 - person.people.radius_m, 10.0}}, {60'000'000'000, {9.55 - person.people.radius_m, 10.0}}}}};
  const double x_person = after(person)->state().pose.x;
  CHECK(x_person < 9.97);
  CHECK(x_person - 0.25 - 9.55 >= clear_gap_m);

  RobotSettings looks_ahead = that_backs_up();
  looks_ahead.lidar.field_of_view_rad = pi;
  const auto blind = after(person, looks_ahead);
  CHECK(blind->state().pose.x == Approx(9.8).margin(0.01));
  CHECK_FALSE(blind->world.contacts().empty());
}

TEST_CASE("a robot that touches a wall before it can back away from it") {
  Scenario scenario = hall();
  scenario.shapes = {box("wall", {10.25, 9}, {11, 11})};
  Trial trial(scenario, that_backs_up(), with_ladder({RecoveryStep::backup}, 1));
  trial.run(20.0);
  CHECK(trial.state().pose.x == Approx(9.7).margin(0.01));
}

TEST_CASE("a robot that arrives while it recovers is left alone") {
  Scenario scenario = hall();
  scenario.robots = {robot({10, 10, 0}, dmrp_vec2{9.6, 10})};
  SimulationSettings settings = with_ladder({RecoveryStep::backup});
  settings.recovery.backup_dist_m = 0.45;
  Trial trial(scenario, that_backs_up(), settings);
  trial.run(30.0);
  CHECK(trial.state().state == DMRP_ROBOT_FINISHED);
  CHECK(trial.steps.size() == 1);
  CHECK_FALSE(trial.ladder.is_recovering(0));
}

}  // namespace recovery_test
