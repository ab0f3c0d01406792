// SPDX-License-Identifier: MIT
// What becomes of robots and people: contacts with somebody at fault, arrival, progress, endings, the population.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/rectangle.hpp>
#include <numbers>
#include <set>
#include <stdexcept>

#include "core/execution/ending.hpp"
#include "core/execution/progress.hpp"
#include "core/scene/world_view.hpp"
#include "core/world/contact_events.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::int64_t step_ns = 20'000'000;
constexpr std::int64_t second_ns = 1'000'000'000;

dmrp_agent agent(std::uint64_t id, dmrp_vec2 position, dmrp_vec2 velocity, double radius_m = 0.25) {
  dmrp_agent made{};
  made.id = id;
  made.pose = {position.x, position.y, 0.0};
  made.velocity = velocity;
  made.radius_m = radius_m;
  return made;
}

// A robot and another body that move straight until they touch at t = 2 s, then stand.
struct Meeting {
  dmrp_vec2 robot_velocity{};
  dmrp_vec2 other_velocity{};
  std::int64_t robot_stops_ns = 2 * second_ns;  // before the contact, if it does
  dmrp_vec2 other_velocity_early{};             // until other_turns_ns
  std::int64_t other_turns_ns = 0;

  std::uint32_t flags(std::uint32_t kind) const {
    ContactTracker tracker(1.0, 0.8);
    const double apart_m = kind == DMRP_CONTACT_PERSON ? 0.55 : 0.5;
    dmrp_contact contact{};
    contact.kind = kind;
    contact.b = kind == DMRP_CONTACT_ROBOT ? 1 : 0;
    for (std::int64_t t_ns = 0; t_ns <= 2 * second_ns; t_ns += step_ns) {
      const double left_s = 1e-9 * static_cast<double>(2 * second_ns - t_ns);
      const bool moves = t_ns < robot_stops_ns;
      const double robot_left_s = std::max(0.0, left_s - 1e-9 * static_cast<double>(2 * second_ns - robot_stops_ns));
      const dmrp_vec2 early = t_ns < other_turns_ns ? other_velocity_early : other_velocity;
      const std::vector<dmrp_agent> robots = {
          agent(0, -robot_left_s * robot_velocity, moves ? robot_velocity : dmrp_vec2{}),
          agent(1, dmrp_vec2{apart_m, 0.0} - left_s * other_velocity, other_velocity)};
      const std::vector<dmrp_agent> people = {agent(77, dmrp_vec2{apart_m, 0.0} - left_s * other_velocity, early, 0.3)};
      if (t_ns < 2 * second_ns) {
        tracker.update(t_ns, robots, people, {});
      } else {
        tracker.update(t_ns, robots, people, {&contact, 1});
      }
    }
    return contact.flags;
  }
};

}  // namespace

TEST_CASE("a contact with something static is the robot's fault") {
  CHECK(Meeting{}.flags(DMRP_CONTACT_STATIC) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a contact with a person is the robot's fault if it moved toward the person in the half second before") {
  const Meeting driving{{0.5, 0.0}, {}};
  CHECK(driving.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
  // too slow to count: 0.04 m/s
  const Meeting creeping{{0.04, 0.0}, {-1.0, 0.0}};
  CHECK(creeping.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  // fast, but away: the person catches up
  const Meeting fleeing{{-0.6, 0.0}, {-1.0, 0.0}};
  CHECK(fleeing.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  // stood for 0.6 s already; for 0.4 s only
  const Meeting stopped{{0.5, 0.0}, {-1.0, 0.0}, 1'400'000'000};
  CHECK(stopped.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  const Meeting just_stopped{{0.5, 0.0}, {-1.0, 0.0}, 1'600'000'000};
  CHECK(just_stopped.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a contact is unavoidable if the person was on no collision course one braking time before") {
  // the robot brakes from 0.8 m/s in 0.8 s; the person walked away from it until 0.5 s before the contact
  Meeting sudden{{0.8, 0.0}, {-1.0, 0.0}};
  sudden.other_velocity_early = {1.5, 0.0};
  sudden.other_turns_ns = 1'500'000'000;
  CHECK(sudden.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A | DMRP_CONTACT_UNAVOIDABLE));
  // turned 0.9 s before: there was time to brake
  Meeting seen = sudden;
  seen.other_turns_ns = 1'100'000'000;
  CHECK(seen.flags(DMRP_CONTACT_PERSON) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("in a contact of robots each that moved toward the other is at fault") {
  CHECK(Meeting{{0.5, 0.0}, {}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
  CHECK(Meeting{{}, {-0.5, 0.0}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_B));
  CHECK(Meeting{{0.5, 0.0}, {-0.5, 0.0}}.flags(DMRP_CONTACT_ROBOT) ==
        (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A | DMRP_CONTACT_FAULT_B));
  // overtaken from behind: the slower one moves away
  CHECK(Meeting{{0.8, 0.0}, {0.4, 0.0}}.flags(DMRP_CONTACT_ROBOT) == (DMRP_CONTACT_BEGINS | DMRP_CONTACT_FAULT_A));
}

TEST_CASE("a contact that pauses for less than half a second is the same event, with the same fault") {
  ContactTracker tracker(1.0, 0.8);
  std::vector<std::int64_t> begins_ns;
  std::uint32_t last_fault = 0;
  for (std::int64_t t_ns = 0; t_ns <= 4 * second_ns; t_ns += step_ns) {
    // the robot drives at the person first and stands later; contact at 1.0 to 1.2, at 1.68, and at 2.18 s
    const bool touching =
        (t_ns >= second_ns && t_ns <= 1'200'000'000) || t_ns == 1'680'000'000 || t_ns == 2'180'000'000;
    const dmrp_vec2 velocity = t_ns < second_ns ? dmrp_vec2{0.5, 0.0} : dmrp_vec2{};
    const std::vector<dmrp_agent> robots = {agent(0, {}, velocity)};
    const std::vector<dmrp_agent> people = {agent(5, {0.54, 0.0}, {}, 0.3)};
    dmrp_contact contact{DMRP_CONTACT_PERSON, 0, 0, 0, 0.0015, {}};
    tracker.update(t_ns, robots, people, std::span(&contact, touching ? 1 : 0));
    if (!touching) continue;
    last_fault = contact.flags & ~DMRP_CONTACT_BEGINS;
    if (t_ns < 2 * second_ns) CHECK(last_fault == DMRP_CONTACT_FAULT_A);
    if ((contact.flags & DMRP_CONTACT_BEGINS) != 0) begins_ns.push_back(t_ns);
  }
  CHECK(begins_ns == std::vector<std::int64_t>{second_ns, 2'180'000'000});
  CHECK(last_fault == DMRP_CONTACT_FAULT_B);
}

TEST_CASE("somebody new in the same slot is another person") {
  ContactTracker tracker(1.0, 0.8);
  const std::vector<dmrp_agent> robots = {agent(0, {}, {})};
  dmrp_contact contact{DMRP_CONTACT_PERSON, 0, 0, 0, 0.0015, {}};
  tracker.update(0, robots, std::vector<dmrp_agent>{agent(1, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) != 0);
  tracker.update(step_ns, robots, std::vector<dmrp_agent>{agent(1, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) == 0);
  tracker.update(2 * step_ns, robots, std::vector<dmrp_agent>{agent(9, {0.5, 0.0}, {})}, {&contact, 1});
  CHECK((contact.flags & DMRP_CONTACT_BEGINS) != 0);
}

TEST_CASE("a robot arrives after half a second at its goal, is parked, and stays a body") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{5.1, 5}), robot({7, 5, pi}, dmrp_vec2{1, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  for (int i = 0; i < 24; ++i) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_FINISHED);
  CHECK(world.robots()[0].arrival_ns == 500'000'000);
  CHECK(world.set_command(0, {0.8, 0.0, 0.0}).v_x == 0.0);
  world.set_command(1, {0.8, 0.0, 0.0});
  for (int i = 0; i < 300; ++i) world.step({});
  CHECK(world.robots()[0].pose.x == 5.0);
  CHECK(world.robots()[1].pose.x == Approx(5.5).margin(0.002));
  CHECK(world.robot_agents()[0].state == DMRP_ROBOT_FINISHED);
}

TEST_CASE("passing a goal at speed is no arrival, and a pause begins anew") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({4, 5, 0}, dmrp_vec2{5, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.8, 0.0, 0.0});
  while (world.robots()[0].pose.x < 6.0) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_ACTIVE);
  CHECK(world.robots()[0].settling_since_ns == -1);
}

TEST_CASE("the goals of a tour become current one after the other, headings where they are given") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, {{5.0, 5.0, any_heading}, {5.0, 5.0, 1.0}})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  for (int i = 0; i < 30; ++i) world.step({});
  CHECK(world.robots()[0].goal_index == 1);
  for (int i = 0; i < 100; ++i) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_ACTIVE);  // not turned yet
  for (int i = 0; i < 300; ++i) {
    world.set_command(0, {0.0, 0.0, 1.0 - world.robots()[0].pose.theta});
    world.step({});
  }
  CHECK(world.robots()[0].state == DMRP_ROBOT_FINISHED);
}

TEST_CASE("a robot that is given up brakes and stands") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{15, 5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 60; ++i) world.step({});
  world.fail(0);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 60; ++i) world.step({});
  CHECK(world.robots()[0].state == DMRP_ROBOT_FAILED);
  CHECK(world.robots()[0].velocity.v_x == 0.0);
}

namespace {

dmrp_waypoint waypoint(double x, double y, std::uint32_t goal = 0) {
  dmrp_waypoint made{};
  made.x = x;
  made.y = y;
  made.goal_index = goal;
  return made;
}

}  // namespace

TEST_CASE("progress follows a path and never falls") {
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(2, 0), waypoint(2, 0), waypoint(2, 2)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.0, 0.3}, 0);
  CHECK(progress.progress_m() == Approx(1.0));
  CHECK(progress.waypoint() == 0);
  progress.update({0.5, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(1.0));
  progress.update({2.1, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(2.0));
  CHECK(progress.waypoint() == 2);  // the wait counts as passed
  progress.update({2.0, 2.5}, 0);
  CHECK(progress.progress_m() == Approx(4.0));
  CHECK(progress.waypoint() == 3);
  CHECK(progress.gained_m() == Approx(4.0));
}

TEST_CASE("progress does not jump to a later lap, nor past a goal that is not reached") {
  // out and back on the same lane, the goal at the far end
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(1, 0), waypoint(2, 0), waypoint(1, 0, 1),
                                           waypoint(0, 0, 1)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.9, 0.05}, 0);
  CHECK(progress.progress_m() == Approx(1.9));
  progress.update({1.2, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(1.9));
  progress.update({2.0, 0.0}, 0);
  progress.update({1.2, 0.0}, 1);
  CHECK(progress.progress_m() == Approx(2.8));
}

TEST_CASE("who cuts off a long detour is found again") {
  std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(0, 6), waypoint(1, 6), waypoint(1, 0), waypoint(9, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  for (int i = 0; i <= 80; ++i) progress.update({0.1 * i, 0.0}, 0);
  // the detour is 13 m long; after as many metres without progress it would be found for certain
  for (int i = 80; i >= 0; --i) progress.update({0.1 * i, 0.0}, 0);
  for (int i = 0; i <= 90; ++i) progress.update({0.1 * i, 0.0}, 0);
  CHECK(progress.progress_m() == Approx(21.0));
}

TEST_CASE("getting onto a new path is no gain") {
  const std::vector<dmrp_waypoint> path = {waypoint(0, 0), waypoint(5, 0)};
  PathProgress progress;
  progress.set_path(path, {0.0, 0.0});
  progress.update({1.0, 0.0}, 0);
  progress.set_path(path, {1.0, 0.0});
  CHECK(progress.progress_m() == Approx(1.0));
  CHECK(progress.gained_m() == Approx(1.0));
  progress.update({1.5, 0.0}, 0);
  CHECK(progress.gained_m() == Approx(1.5));
}

namespace {

// Robots whose progress is given, watched at 10 Hz until an ending or 100 s.
struct Watch {
  EndingMonitor monitor;
  std::vector<RobotState> robots;
  std::int64_t ended_ns = -1;

  Watch(std::uint32_t count, std::int64_t limit_ns) : monitor(count, limit_ns), robots(count) {}

  template <class Move>
  std::uint32_t run(const Move& move) {
    std::vector<double> gained(robots.size(), 0.0);
    for (std::int64_t t_ns = 0; t_ns <= 100 * second_ns; t_ns += 100'000'000) {
      move(1e-9 * static_cast<double>(t_ns), robots, gained, monitor, t_ns);
      const std::uint32_t ending = monitor.update(t_ns, robots, gained);
      ended_ns = t_ns;
      if (ending != 0) return ending;
    }
    return 0;
  }
};

void command_all(EndingMonitor& monitor, std::size_t robots, std::int64_t t_ns) {
  for (std::uint32_t i = 0; i < robots; ++i) monitor.command_given(i, t_ns);
}

}  // namespace

TEST_CASE("a trial ends when all have arrived, or at the time limit") {
  Watch arriving(2, 60 * second_ns);
  const auto ending = arriving.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    gained = {t, t};
    for (std::size_t i = 0; i < 2; ++i) {
      if (t >= 10.0 + static_cast<double>(i)) {
        robots[i].state = DMRP_ROBOT_FINISHED;
        robots[i].arrival_ns = t_ns;
      }
    }
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(arriving.ended_ns == 11 * second_ns);
  CHECK(arriving.monitor.robot_ends(ending, arriving.robots)[1].failure == DMRP_FAILURE_NONE);

  Watch slow(1, 60 * second_ns);
  CHECK(slow.run([](double t, auto&, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 1, t_ns);
    gained = {0.011 * t};
  }) == DMRP_ENDING_TIME_LIMIT);
  CHECK(slow.ended_ns == 60 * second_ns);
  CHECK(slow.monitor.robot_ends(DMRP_ENDING_TIME_LIMIT, slow.robots)[0].failure == DMRP_FAILURE_TIMEOUT);
}

TEST_CASE("a deadlock is 20 s without 0.2 m of progress of any unfinished robot") {
  Watch watch(3, 90 * second_ns);
  const auto ending = watch.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 3, t_ns);
    // one has arrived, one stands from the beginning, one advances until 7 s and then creeps
    robots[0].state = DMRP_ROBOT_FINISHED;
    gained = {0.0, 0.0, t < 7.0 ? t : 7.0 + 0.009 * (t - 7.0)};
  });
  CHECK(ending == DMRP_ENDING_DEADLOCK);
  // from 27 s on the window begins at 7 s, where all that is left is 20 s * 0.009 m/s = 0.18 m
  CHECK(watch.ended_ns == 27 * second_ns);
  const auto ends = watch.monitor.robot_ends(ending, watch.robots);
  CHECK(ends[0].failure == DMRP_FAILURE_NONE);
  CHECK(ends[1].failure == DMRP_FAILURE_DEADLOCK);
}

TEST_CASE("oscillation is recorded for good and ends nothing") {
  Watch watch(2, 90 * second_ns);
  const auto ending = watch.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    // the first goes to and fro by 0.2 m until 30 s, then advances and arrives; the second stands still, but advances
    robots[0].pose.x = 0.1 * std::sin(t);
    gained = {t < 30.0 ? 0.0 : t - 30.0, 0.02 * t};
    if (t > 40.0) robots[0].state = robots[1].state = DMRP_ROBOT_FINISHED;
  });
  CHECK(ending == DMRP_ENDING_ARRIVED);
  CHECK(watch.monitor.failure(0) == DMRP_FAILURE_OSCILLATION);
  CHECK(watch.monitor.failure(1) == DMRP_FAILURE_NONE);
  CHECK(watch.monitor.robot_ends(ending, watch.robots)[0].failure == DMRP_FAILURE_OSCILLATION);

  Watch turning(2, 90 * second_ns);
  turning.run([](double t, auto& robots, auto& gained, auto& monitor, std::int64_t t_ns) {
    command_all(monitor, 2, t_ns);
    robots[0].pose.theta = std::remainder(0.65 * t, 2.0 * pi);  // 13 rad in 20 s, more than 4 pi
    robots[1].pose.theta = std::remainder(0.6 * t, 2.0 * pi);   // 12 rad
    gained = {0.0, t > 21.0 ? t : 0.0};
  });
  CHECK(turning.monitor.failure(0) == DMRP_FAILURE_OSCILLATION);
  CHECK(turning.monitor.failure(1) == DMRP_FAILURE_NONE);
}

TEST_CASE("five seconds without a command are a failure of the controller") {
  Watch watch(1, 90 * second_ns);
  std::int64_t failed_ns = -1;
  watch.run([&](double t, auto&, auto& gained, auto& monitor, std::int64_t t_ns) {
    gained = {t};
    if (t < 10.05) monitor.command_given(0, t_ns);
    if (failed_ns < 0 && monitor.failure(0) == DMRP_FAILURE_CONTROLLER) failed_ns = t_ns;
  });
  CHECK(failed_ns == 15'100'000'000);  // seen one tick after 15.0 s
}

namespace {

Scenario busy_hall(std::uint32_t people) {
  Scenario scenario = empty_scenario(30, 12);
  scenario.shapes = {box("kiosk", {14, 4}, {16, 8}), circle("planter", {8, 6}, 0.7)};
  scenario.regions = {{"west", {0.5, 1}, {2.5, 11}}, {"north", {14, 9}, {16, 11}}, {"east", {27.5, 1}, {29.5, 11}}};
  scenario.flows = {{"eastward", {0, 1, 2}, people / 2}, {"westward", {2, 0}, people - people / 2}};
  return scenario;
}

std::vector<dmrp_vec2> straight_on(const World& world) {
  std::vector<dmrp_vec2> velocities;
  for (const dmrp_person& person : world.people())
    velocities.push_back(person.desired_speed * toolkit::normalized(person.target - person.position));
  return velocities;
}

}  // namespace

TEST_CASE("people begin along their flows, free and apart, with speeds as set") {
  Scenario scenario = busy_hall(30);
  scenario.robots = {robot({5, 6, 0}, dmrp_vec2{25, 6}), robot({20, 3, 0}, dmrp_vec2{5, 3})};
  const auto geometry = geometry_of(scenario);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world(scenario, RobotSettings{}, SimulationSettings{}, geometry, seed);
    REQUIRE(world.people().size() == 30);
    std::set<std::uint64_t> ids;
    double west_most = 30.0;
    double east_most = 0.0;
    for (const dmrp_person& person : world.people()) {
      ids.insert(person.id);
      CHECK(geometry->disc_is_free(person.position, 0.3));
      CHECK(person.desired_speed >= 0.5);
      CHECK(person.desired_speed <= 2.0);
      CHECK(toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.target));
      for (const RobotState& state : world.robots())
        CHECK(toolkit::distance(person.position, toolkit::position(state.pose)) >= 1.5);
      for (const dmrp_person& other : world.people())
        if (&other != &person) CHECK(toolkit::distance(person.position, other.position) >= 0.6);
      west_most = std::min(west_most, person.position.x);
      east_most = std::max(east_most, person.position.x);
    }
    CHECK(ids.size() == 30);
    CHECK(west_most < 8.0);
    CHECK(east_most > 22.0);
  }
}

TEST_CASE("the crowd of a seed does not depend on the robots") {
  const Scenario without = busy_hall(10);
  Scenario with = without;
  with.robots = {robot({15, 2, 0}, dmrp_vec2{25, 6})};
  const World one(without, RobotSettings{}, SimulationSettings{}, geometry_of(without), 5);
  const World two(with, RobotSettings{}, SimulationSettings{}, geometry_of(with), 5);
  const World other(without, RobotSettings{}, SimulationSettings{}, geometry_of(without), 6);
  int moved = 0;
  int same_as_other = 0;
  for (std::size_t i = 0; i < one.people().size(); ++i) {
    CHECK(one.people()[i].desired_speed == two.people()[i].desired_speed);
    CHECK(one.people()[i].target == two.people()[i].target);
    if (one.people()[i].position != two.people()[i].position) {
      ++moved;
      CHECK(toolkit::distance(one.people()[i].position, {15, 2}) < 1.5 + 3.0);
    }
    if (one.people()[i].position == other.people()[i].position) ++same_as_other;
  }
  CHECK(moved <= 2);
  CHECK(same_as_other == 0);
}

TEST_CASE("people go from region to region, leave, and new ones begin away from robots") {
  Scenario scenario = busy_hall(8);
  scenario.shapes.clear();
  scenario.robots = {robot({1.5, 6, 0}, dmrp_vec2{25, 6})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 3);
  std::set<std::uint64_t> ids;
  std::set<std::uint32_t> targets;
  bool begin_away = true;
  bool begin_in_first_region = true;
  for (int step = 0; step < 6000; ++step) {
    const std::vector<dmrp_person> before(world.people().begin(), world.people().end());
    world.step(straight_on(world));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const dmrp_person& person = world.people()[i];
      targets.insert(person.target_id);
      ids.insert(person.id);
      if (person.id == before[i].id) continue;
      begin_away = begin_away && toolkit::distance(person.position, {1.5, 6}) >= 1.5;
      const Region& first = scenario.regions[i < 4 ? 0 : 2];
      begin_in_first_region =
          begin_in_first_region && toolkit::contains(toolkit::Rectangle{first.lower, first.upper}, person.position);
      CHECK(person.id % 8 == i);
    }
  }
  CHECK(world.people().size() == 8);
  CHECK(ids.size() > 20);
  CHECK(targets == std::set<std::uint32_t>{0, 1, 2});
  CHECK(begin_away);
  CHECK(begin_in_first_region);
}

TEST_CASE("who finds no room to begin anew keeps walking until there is some") {
  Scenario scenario = busy_hall(0);
  scenario.shapes.clear();
  scenario.regions = {{"gate", {1, 5}, {2, 6}}, {"east", {27.5, 1}, {29.5, 11}}};
  scenario.flows = {{"eastward", {0, 1}, 1}};
  scenario.robots = {robot({1.5, 5.5, 0}, dmrp_vec2{15, 5.5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 3);
  for (int step = 0; step < 3000; ++step) world.step(straight_on(world));
  CHECK(world.people()[0].id == 0);
  CHECK(world.people()[0].position.x > 26.0);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int step = 0; step < 500; ++step) world.step(straight_on(world));
  CHECK(world.people()[0].id == 1);
}

TEST_CASE("more people than there is room for are refused") {
  Scenario scenario = empty_scenario(4, 4);
  scenario.regions = {{"west", {0, 0}, {1, 4}}, {"east", {3, 0}, {4, 4}}};
  scenario.flows = {{"across", {0, 1}, 60}};
  CHECK_THROWS_AS(World(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1), std::runtime_error);
}

TEST_CASE("a world shown to plugins has everything, also as a copy of a copy") {
  Scenario scenario = busy_hall(6);
  scenario.robots = {robot({5, 6, any_heading}, {{25, 6, any_heading}, {5, 6, 1.0}})};
  scenario.robots[0].name = "anna";
  const StaticGeometry geometry(scenario);
  const PlanningGrid planning = build_planning_grid(geometry, 1.0, 0.25, 0.1);
  const PlanningGrid walking = build_walking_grid(geometry, 0.3);
  std::unique_ptr<WorldView> copy;
  {
    const WorldView view(scenario, RobotSettings{}, SimulationSettings{}, geometry, planning, walking, 5);
    CHECK(view.seen_by(0).self == 0);
    copy = std::make_unique<WorldView>(view.world());
  }
  const WorldView moved(std::move(*copy));
  const WorldView kept(moved.world());
  const dmrp_world& last = kept.world();
  CHECK(last.struct_size == sizeof(dmrp_world));
  CHECK(last.person_count == 6);
  CHECK(last.self == -1);
  CHECK(last.call_budget_ns == 5);
  CHECK(last.upper == dmrp_vec2{30, 12});
  REQUIRE(last.robot_count == 1);
  CHECK(std::string(last.robots[0].name) == "anna");
  REQUIRE(last.robots[0].goal_count == 2);
  CHECK(last.robots[0].goals[1].pose.theta == 1.0);
  CHECK(last.robots[0].goals[0].settle_ns == 500'000'000);
  CHECK(last.robots[0].limits->v_max == 0.8);
  CHECK(last.robots[0].footprint->radius_m == 0.25);
  CHECK(last.robots[0].footprint->vertices == nullptr);
  CHECK(last.robots[0].start.theta == 0.0);
  REQUIRE(last.shape_count == 2);
  CHECK(std::string(last.shapes[1].name) == "planter");
  CHECK(last.shapes[1].kind == DMRP_SHAPE_CIRCLE);
  CHECK(last.shapes[0].vertices[2] == dmrp_vec2{16, 8});
  CHECK(last.segment_count == 4 + 24 + 4);
  CHECK(last.planning_grid->width == 30);
  CHECK(last.planning_grid->free[0] == planning.free[0]);
  CHECK(last.walking_grid->width == 120);
}
