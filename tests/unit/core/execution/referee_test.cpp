// SPDX-License-Identifier: MIT
// The worked examples, the invariants and the planted misbehaviours of the rules in referee.hpp.
#include "core/execution/referee.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <functional>
#include <set>

#include "core/execution/progress.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace referee_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;
using toolkit::Stream;

constexpr double pi = 3.14159265358979323846;
constexpr double period_s = 0.1;

RobotSettings agile() {
  RobotSettings robot;
  robot.drive = Drive::holonomic;
  robot.v_min = -2.0;
  robot.v_max = robot.v_y_max = 2.0;
  robot.omega_max = 10.0;
  robot.a_max = robot.alpha_max = 1000.0;
  return robot;
}

SimulationSettings at_10_hz(double time_limit_s) {
  SimulationSettings settings;
  settings.step_ns = settings.control_period_ns = 100'000'000;
  settings.time_limit_ns = static_cast<std::int64_t>(1e9 * time_limit_s);
  return settings;
}

std::vector<dmrp_waypoint> path_through(const std::vector<dmrp_vec2>& corners) {
  std::vector<dmrp_waypoint> path;
  for (const dmrp_vec2 corner : corners) {
    dmrp_waypoint waypoint{};
    waypoint.x = corner.x;
    waypoint.y = corner.y;
    path.push_back(waypoint);
  }
  return path;
}

// What a robot does in the next period: a velocity in the world frame and a turning rate.
struct Motion {
  dmrp_vec2 velocity{};
  double omega = 0.0;
};
using Driver = std::function<Motion(double t_s, std::uint32_t robot, const World& world)>;

Motion toward(const World& world, std::uint32_t robot, dmrp_vec2 target, double speed) {
  const dmrp_vec2 way = target - toolkit::position(world.robots()[robot].pose);
  const double distance_m = toolkit::norm(way);
  return {distance_m < 1e-9 ? dmrp_vec2{} : std::min(speed, distance_m / period_s) / distance_m * way};
}

// A trial without plugins: robots that move as the test says, on courses that the test gives.
struct Match {
  Scenario scenario;
  RobotTypes types;
  std::shared_ptr<const StaticGeometry> geometry;
  PlanningGrids grids;
  World world;
  Referee referee;
  std::vector<std::vector<dmrp_waypoint>> paths;
  std::vector<PathProgress> progress;
  std::vector<CoursePlace> places;
  std::vector<std::set<std::uint32_t>> classes;  // by robot: all that it was in
  std::function<dmrp_vec2(double t_s)> walk;     // the velocity of all people; none: they stand

  Match(Scenario of, double time_limit_s, Referee::Settings settings = {}, std::uint64_t seed = 1)
      : scenario(std::move(of)),
        types(agile()),
        geometry(geometry_of(scenario)),
        grids(*geometry, types, {}),
        world(scenario, types, at_10_hz(time_limit_s), geometry, seed),
        referee(world, grids, settings, seed),
        paths(world.robots().size()),
        progress(world.robots().size()),
        places(world.robots().size()),
        classes(world.robots().size()) {}

  void plan(std::uint32_t robot, const std::vector<dmrp_vec2>& corners) {
    paths[robot] = path_through(corners);
    progress[robot].set_path(paths[robot], toolkit::position(world.robots()[robot].pose));
    const std::uint64_t revision = places[robot].revision + 1;
    places[robot] = {};
    places[robot].revision = revision;
    places[robot].path = paths[robot];
    follow(robot);
  }

  void follow(std::uint32_t robot) {
    if (paths[robot].empty()) return;
    places[robot].arc_m = progress[robot].progress_m();
    places[robot].passed = progress[robot].waypoint();
  }

  double t_s() const { return 1e-9 * static_cast<double>(world.t_ns()); }

  // Until an ending, which it returns, or until_s; then 0.
  std::uint32_t run(double until_s, const Driver& driver) {
    while (t_s() < until_s - 1e-9) {
      referee.judge_progress(places);
      for (std::uint32_t i = 0; i < places.size(); ++i) {
        if (world.robots()[i].state != DMRP_ROBOT_ACTIVE) continue;
        classes[i].insert(referee.class_of(i));
        const Motion motion = driver(t_s(), i, world);
        const dmrp_vec2 own = toolkit::rotate(motion.velocity, -world.robots()[i].pose.theta);
        world.set_command(i, {own.x, own.y, motion.omega});
        referee.command_given(i);
      }
      world.step(std::vector<dmrp_vec2>(world.people().size(), walk ? walk(t_s()) : dmrp_vec2{}));
      referee.judge_arrivals(places);
      for (std::uint32_t i = 0; i < places.size(); ++i) {
        const RobotState& robot = world.robots()[i];
        progress[i].update(toolkit::position(robot.pose), robot.goal_index);
        follow(i);
      }
      if (const std::uint32_t ending = referee.ending()) return ending;
    }
    return 0;
  }

  dmrp_robot_end end_of(std::uint32_t robot, std::uint32_t ending = DMRP_ENDING_TIME_LIMIT) const {
    return referee.robot_ends(ending)[robot];
  }
};

Scenario hall(const std::vector<RobotTask>& robots, double width_m = 60.0, double height_m = 30.0) {
  Scenario scenario = empty_scenario(width_m, height_m);
  scenario.robots = robots;
  return scenario;
}

TEST_CASE("a robot that drives beside paths that change every second makes progress") {
  Match match(hall({robot({2.0, 15.43, 0.0}, dmrp_vec2{50.5, 16.5})}), 100.0);
  match.run(60.0, [&](double t_s, std::uint32_t i, const World& world) -> Motion {
    if (std::fmod(t_s + 1e-6, 1.0) < 0.05) {
      const double x = std::floor(world.robots()[i].pose.x) + 0.5;
      match.plan(i, {{x, 16.5}, {50.5, 16.5}});
    }
    return {{0.5, 0.0}};
  });
  CHECK(match.classes[0] == std::set<std::uint32_t>{DMRP_CLASS_MOVING});
  CHECK(match.referee.gained_m()[0] >= 0.5 * 60.0 - 2.0);
}

TEST_CASE("a robot that has to leave its goal again visits it, and parks when it comes back") {
  Match match(hall({robot({5.5, 15.5, 0.0}, dmrp_vec2{8.5, 15.5})}), 100.0);
  match.plan(0, {{5.5, 15.5}, {8.5, 15.5}, {8.5, 16.5}, {8.5, 15.5}});
  match.places[0].returns = true;
  const auto to = [&](dmrp_vec2 target) {
    return [target](double, std::uint32_t i, const World& world) { return toward(world, i, target, 0.5); };
  };
  CHECK(match.run(10.0, to({8.5, 15.5})) == 0);
  CHECK(match.world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  CHECK(match.end_of(0).visits == 1);
  CHECK(match.run(14.0, to({8.5, 16.5})) == 0);
  match.places[0].returns = false;
  CHECK(match.run(30.0, to({8.5, 15.5})) == DMRP_ENDING_ARRIVED);
  CHECK(match.end_of(0).failure == DMRP_FAILURE_NONE);
  CHECK(match.end_of(0).visits == 2);
}

TEST_CASE("a robot that waits at its goal to give way asks for a plan, and is parked by it") {
  Match match(hall({robot({8.5, 15.5, 0.0}, dmrp_vec2{8.5, 15.5})}), 100.0, {false, true});
  CHECK(match.world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  match.plan(0, {{8.5, 15.5}, {8.5, 16.5}, {8.5, 15.5}});
  match.places[0].returns = true;
  const auto stand = [](double, std::uint32_t, const World&) { return Motion{}; };
  match.run(20.0, stand);
  CHECK_FALSE(match.referee.wants_plan());
  match.run(21.0, stand);
  CHECK(match.referee.wants_plan());
  CHECK_FALSE(match.referee.wants_plan());  // once a window
  match.plan(0, {{8.5, 15.5}});
  CHECK(match.run(22.0, stand) == DMRP_ENDING_ARRIVED);
}

TEST_CASE("a robot that circles and then arrives has succeeded, unless the experiment excludes it") {
  const bool excludes = GENERATE(false, true);
  Match match(hall({robot({5.5, 15.5, 0.0}, dmrp_vec2{20.5, 15.5})}), 200.0, {excludes, false});
  match.plan(0, {{5.5, 15.5}, {20.5, 15.5}});
  const std::uint32_t ending = match.run(200.0, [&](double t_s, std::uint32_t i, const World& world) -> Motion {
    if (t_s > 10.0 && t_s < 34.0) return {{}, 0.63};  // 15 rad
    return toward(world, i, {20.5, 15.5}, 0.5);
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  bool circled = false;
  for (const dmrp_robot_event& change : match.referee.take_changes())
    circled = circled || (change.detail & DMRP_CLASS_CIRCLING) != 0;
  CHECK(circled);
  CHECK(match.end_of(0, ending).failure == (excludes ? DMRP_FAILURE_OSCILLATION : DMRP_FAILURE_NONE));
}

TEST_CASE("a detour that the plan wants is progress") {
  // away from the goal first: 34 m for 10 m
  Match match(hall({robot({20.5, 5.5, 0.0}, dmrp_vec2{30.5, 5.5})}), 100.0);
  const std::vector<dmrp_vec2> corners = {{20.5, 5.5}, {14.5, 5.5}, {14.5, 11.5}, {30.5, 11.5}, {30.5, 5.5}};
  match.plan(0, corners);
  std::size_t next = 1;
  const std::uint32_t ending = match.run(100.0, [&](double, std::uint32_t i, const World& world) {
    if (next + 1 < corners.size() && toolkit::distance(corners[next], toolkit::position(world.robots()[i].pose)) < 0.05)
      ++next;
    return toward(world, i, corners[next], 0.8);
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(match.classes[0].count(DMRP_CLASS_STUCK) == 0);
}

TEST_CASE("plans that alternate for ever are no progress once the credit is gone") {
  Match match(hall({robot({20.5, 15.5, 0.0}, dmrp_vec2{40.5, 15.5})}), 180.0);
  double lost_s = 0.0;
  int leg = -1;
  const std::uint32_t ending = match.run(180.0, [&](double t_s, std::uint32_t i, const World& world) {
    const dmrp_vec2 side = {20.5, leg % 2 == 0 ? 17.0 : 14.0};
    if (static_cast<int>(t_s / 4.0) != leg) {
      leg = static_cast<int>(t_s / 4.0);
      const dmrp_vec2 to = {20.5, leg % 2 == 0 ? 17.0 : 14.0};
      match.plan(i, {toolkit::position(world.robots()[i].pose), to, {40.5, 15.5}});
    }
    if (match.referee.class_of(i) != DMRP_CLASS_MOVING && lost_s == 0.0) lost_s = t_s;
    return toward(world, i, side, 0.8);
  });
  CHECK(ending == DMRP_ENDING_TIME_LIMIT);
  CHECK(match.end_of(0).failure == DMRP_FAILURE_CIRCLING);
  CHECK(lost_s > 30.0);
  CHECK(lost_s < 100.0);
}

TEST_CASE("robots that are held behind a failed one end the trial at once where nothing can replan") {
  const bool replans = GENERATE(false, true);
  std::vector<RobotTask> robots;
  for (int i = 0; i < 4; ++i) robots.push_back(robot({5.5, 5.5 + 3 * i, 0.0}, dmrp_vec2{40.5, 5.5 + 3 * i}));
  Match match(hall(robots), 100.0, {false, replans});
  for (std::uint32_t i = 0; i < 4; ++i) {
    match.plan(i, {{5.5, 5.5 + 3 * i}, {40.5, 5.5 + 3 * i}});
    if (i > 0) match.places[i].holder = i - 1;
  }
  match.world.fail(0);
  const std::uint32_t ending = match.run(5.0, [](double, std::uint32_t, const World&) { return Motion{}; });
  CHECK(ending == (replans ? 0u : std::uint32_t{DMRP_ENDING_DEADLOCK}));
  CHECK(match.end_of(3).failure == DMRP_FAILURE_HELD_BEHIND);
  CHECK(match.end_of(3).culprit == 0);  // through those that are held themselves
}

TEST_CASE("a goal of a tour is visited, and the next one begins a window") {
  Match match(hall({robot({5.5, 5.5, 0.0}, {{8.5, 5.5, any_heading}, {8.5, 20.5, any_heading}})}), 100.0);
  match.plan(0, {{5.5, 5.5}, {8.5, 5.5}, {8.5, 20.5}});
  const std::uint32_t ending = match.run(100.0, [](double, std::uint32_t i, const World& world) {
    const dmrp_pose& goal = world.goals(i)[world.robots()[i].goal_index].pose;
    return toward(world, i, {goal.x, goal.y}, 0.5);
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(match.end_of(0).visits == 2);
  CHECK(match.referee.gained_m()[0] == Approx(18.0).margin(0.5));
}

TEST_CASE("a standstill ends the trial after half a minute, unless somebody moves nearby") {
  const bool somebody = GENERATE(false, true);
  Match match(hall({robot({5.5, 5.5, 0.0}, dmrp_vec2{40.5, 5.5}), robot({5.5, 7.5, 0.0}, dmrp_vec2{7.5, 7.5})}), 90.0);
  for (std::uint32_t i = 0; i < 2; ++i) match.plan(i, {{5.5, 5.5 + 2 * i}, {40.5, 5.5 + 2 * i}});
  const std::uint32_t ending = match.run(100.0, [&](double t_s, std::uint32_t i, const World&) -> Motion {
    if (i == 0 || !somebody) return {};
    return {{0.3 * std::sin(t_s), 0.0}};
  });
  CHECK(ending == (somebody ? DMRP_ENDING_TIME_LIMIT : DMRP_ENDING_DEADLOCK));
  CHECK(match.end_of(0, ending).failure == DMRP_FAILURE_STUCK);
  if (!somebody) CHECK(match.t_s() == Approx(30.0).margin(0.2));
}

TEST_CASE("a robot that people who mill about block runs to the limit, whether it creeps or stands") {
  const double creep = GENERATE(0.005, 0.0);  // 0.1 m in 20 s
  Scenario scenario = hall({robot({5.5, 5.5, 0.0}, dmrp_vec2{40.5, 5.5})});
  scenario.regions = {{"ahead", {8.0, 4.5}, {10.0, 6.5}}, {"away", {50.0, 20.0}, {52.0, 22.0}}};
  scenario.flows = {{"crowd", {0, 1}, 1, FlowStart::from}};
  Match match(scenario, 90.0);
  match.plan(0, {{5.5, 5.5}, {40.5, 5.5}});
  // the person steps on the robot's course and goes to and fro there
  const auto person = [&] { return toolkit::position(match.world.person_agents()[0].pose); };
  match.walk = [&](double t_s) {
    const double off_m = person().y - 5.5;
    return dmrp_vec2{0.0, std::abs(off_m) > 0.3 ? std::copysign(0.5, -off_m) : std::fmod(t_s, 2.0) < 1.0 ? 0.5 : -0.5};
  };
  const std::uint32_t ending = match.run(100.0, [&](double, std::uint32_t, const World& world) {
    const double room_m = person().x - world.robots()[0].pose.x;
    return Motion{{room_m > 1.4 ? 0.5 : creep, 0.0}};
  });
  CHECK(ending == DMRP_ENDING_TIME_LIMIT);
  CHECK(match.classes[0] == std::set<std::uint32_t>{DMRP_CLASS_MOVING, DMRP_CLASS_BLOCKED_PERSON});
  CHECK(match.end_of(0, ending).failure == DMRP_FAILURE_BLOCKED_PERSON);
}

TEST_CASE("a share of the standstills runs to the limit, and the trace tells of it") {
  int continued = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Match match(hall({robot({5.5, 5.5, 0.0}, dmrp_vec2{40.5, 5.5})}), 31.0, {}, seed);
    match.plan(0, {{5.5, 5.5}, {40.5, 5.5}});
    const auto stand = [](double, std::uint32_t, const World&) { return Motion{}; };
    const bool runs_on = match.run(40.0, stand) == DMRP_ENDING_TIME_LIMIT;
    if (runs_on) ++continued;
    const std::vector<dmrp_robot_event> told = match.referee.take_changes();
    CHECK(std::count_if(told.begin(), told.end(), [](const dmrp_robot_event& event) {
            return event.kind == DMRP_ROBOT_EVENT_RUNS_ON && event.robot == 0;
          }) == (runs_on ? 1 : 0));
  }
  CHECK(continued > 5);  // of 20 expected
  CHECK(continued < 40);
}

TEST_CASE("a trial without robots ends when everybody has left, or at the time limit") {
  Match nobody(hall({}), 10.0);
  CHECK(nobody.referee.ending() == DMRP_ENDING_DESERTED);
  Scenario peopled = hall({});
  peopled.regions = {{"west", {1.0, 1.0}, {5.0, 5.0}}, {"east", {20.0, 1.0}, {25.0, 5.0}}};
  peopled.flows.push_back({"across", {0, 1}, 2, FlowStart::from});
  Match match(peopled, 10.0);
  CHECK(match.run(20.0, {}) == DMRP_ENDING_TIME_LIMIT);
  CHECK(match.referee.robot_ends(DMRP_ENDING_TIME_LIMIT).empty());
}

TEST_CASE("a controller that gives no command for five seconds has failed") {
  Match match(hall({robot({5.5, 5.5, 0.0}, dmrp_vec2{40.5, 5.5})}), 90.0);
  for (int i = 0; i < 52; ++i) {
    match.referee.judge_progress(match.places);
    match.world.step({});
    match.referee.judge_arrivals(match.places);
  }
  CHECK(match.world.robots()[0].state == DMRP_ROBOT_FAILED);
  CHECK(match.referee.ending() == DMRP_ENDING_OVER);
  CHECK(match.end_of(0, DMRP_ENDING_OVER).failure == DMRP_FAILURE_CONTROLLER);
}

TEST_CASE("whatever the plans, the gain never decreases, is bounded, and covers the way to the goal") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Stream random(seed, "referee.invariants");
    const dmrp_vec2 start = {random.uniform(2.0, 58.0), random.uniform(2.0, 28.0)};
    const dmrp_vec2 goal = {random.uniform(2.0, 58.0), random.uniform(2.0, 28.0)};
    CAPTURE(seed);
    Match match(hall({robot({start.x, start.y, 0.0}, goal)}), 400.0);
    double before_m = 0.0;
    double first_leg_m = -1.0;
    dmrp_vec2 target = goal;
    match.run(400.0, [&](double t_s, std::uint32_t i, const World& world) {
      if (static_cast<int>(10.0 * t_s) % 40 == 0) {
        const dmrp_vec2 here = toolkit::position(world.robots()[i].pose);
        const dmrp_vec2 by = {random.uniform(2.0, 58.0), random.uniform(2.0, 28.0)};
        target = t_s > 150.0 ? goal : by;
        const double gained_m = match.referee.gained_m()[i];
        match.plan(i, {here, by, goal});
        if (first_leg_m < 0.0) first_leg_m = toolkit::distance(here, by) + toolkit::distance(by, goal);
        CHECK(match.referee.gained_m()[i] == gained_m);  // a plan alone is no gain
      }
      CHECK(match.referee.gained_m()[i] >= before_m);
      before_m = match.referee.gained_m()[i];
      return toward(world, i, target, 0.8);
    });
    const double way_m = toolkit::distance(start, goal);
    CHECK(match.world.robots()[0].state == DMRP_ROBOT_FINISHED);
    CHECK(before_m >= way_m - 0.3);
    CHECK(before_m <= 1.1 * way_m + first_leg_m + 20.0 + 1.0);
  }
}

struct Misbehaviour {
  const char* name;
  std::set<std::uint32_t> failures;  // one of these names it
  std::function<Motion(double, std::uint32_t, const World&, Stream&)> drive;
};

TEST_CASE("planted misbehaviours end without success, each with its class") {
  const double draw = GENERATE(range(0, 20));
  const std::vector<Misbehaviour> planted = {
      {"orbits",
       {DMRP_FAILURE_CIRCLING},
       [](double t_s, std::uint32_t, const World&, Stream&) -> Motion {
         return {{0.4 * std::cos(0.8 * t_s), 0.4 * std::sin(0.8 * t_s)}};
       }},
      {"creeps",
       {DMRP_FAILURE_STUCK},
       [](double, std::uint32_t, const World&, Stream&) -> Motion {
         return {{0.005, 0.0}};
       }},
      {"turns in place",
       {DMRP_FAILURE_CIRCLING},
       [](double, std::uint32_t, const World&, Stream&) -> Motion {
         return {{}, 0.9};
       }},
      {"deserts",
       {DMRP_FAILURE_CIRCLING, DMRP_FAILURE_STUCK},
       [](double t_s, std::uint32_t, const World&, Stream&) -> Motion {
         return {{t_s < 60.0 ? -0.2 : 0.0, 0.0}};
       }},
      {"goes to and fro",
       {DMRP_FAILURE_CIRCLING},
       [](double t_s, std::uint32_t, const World&, Stream&) -> Motion {
         return {{std::fmod(t_s, 10.0) < 5.0 ? 0.3 : -0.3, 0.0}};
       }},
      {"swaps its place with another's for ever",
       {DMRP_FAILURE_CIRCLING},
       [](double t_s, std::uint32_t i, const World&, Stream&) -> Motion {
         return {{(std::fmod(t_s, 20.0) < 10.0) == (i == 0) ? 0.4 : -0.4, 0.0}};
       }},
  };
  Stream random(static_cast<std::uint64_t>(draw), "referee.planted");
  const double y = std::floor(random.uniform(5.0, 25.0)) + 0.5;
  for (const Misbehaviour& it : planted) {
    CAPTURE(it.name, draw);
    Match match(hall({robot({20.5, y, random.uniform(-pi, pi)}, dmrp_vec2{50.5, y}),
                      robot({24.5, y + 2.0, random.uniform(-pi, pi)}, dmrp_vec2{54.5, y + 2.0})}),
                180.0);
    match.plan(0, {{20.5, y}, {50.5, y}});
    match.plan(1, {{24.5, y + 2.0}, {54.5, y + 2.0}});
    const std::uint32_t ending = match.run(
        200.0, [&](double t_s, std::uint32_t i, const World& world) { return it.drive(t_s, i, world, random); });
    for (std::uint32_t i = 0; i < 2; ++i) {
      const dmrp_robot_end end = match.end_of(i, ending);
      CHECK(end.state != DMRP_ROBOT_FINISHED);
      CHECK(it.failures.count(end.failure) == 1);
    }
  }
}

TEST_CASE("honest slow drives all succeed") {
  for (std::uint64_t draw = 0; draw < 100; ++draw) {
    Stream random(draw, "referee.honest");
    CAPTURE(draw);
    const dmrp_vec2 goal = {random.uniform(8.0, 12.0), random.uniform(5.0, 25.0)};
    Match match(hall({robot({5.5, 15.5, 0.0}, goal)}), 3000.0);
    match.plan(0, {{5.5, 15.5}, goal});
    const double speed = random.uniform(0.015, 0.05);
    const double pause_s = random.uniform(0.0, 8.0);  // in every 20 s
    const std::uint32_t ending = match.run(3000.0, [&](double t_s, std::uint32_t i, const World& world) {
      return std::fmod(t_s, 20.0) < pause_s ? Motion{} : toward(world, i, goal, 2.0 * speed);
    });
    CHECK(ending == DMRP_ENDING_ARRIVED);
    CHECK(match.end_of(0, ending).failure == DMRP_FAILURE_NONE);
  }
}

}  // namespace referee_test
