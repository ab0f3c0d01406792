// SPDX-License-Identifier: MIT
// Blocked time, deadlock and neighbours: cases computed by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace interaction_test {

using Catch::Matchers::WithinAbs;
using namespace dmrp::test;

// Two samples a second from 0 to `end_s`, the robots as `at_time` says.
void fill(SyntheticTrial& trial, double begin_s, double end_s,
          const std::function<std::vector<dmrp_robot_sample>(double)>& at_time) {
  for (double t = begin_s; t <= end_s; t += 0.5) trial.sample(t, at_time(t));
}

// Robots that stand at these places at the beginning of their straight paths of 3 m to these directions.
SyntheticTrial standing(const std::vector<dmrp_vec2>& places, const std::vector<dmrp_vec2>& directions) {
  SyntheticTrial trial(places.size());
  std::vector<Points> paths;
  for (std::size_t i = 0; i < places.size(); ++i)
    paths.push_back({places[i], {places[i].x + 3 * directions[i].x, places[i].y + 3 * directions[i].y}});
  trial.plan(paths);
  return trial;
}

TEST_CASE("the time without progress is told by its cause") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {9, 0}}});
  trial.sample(0.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_MOVING)});
  trial.sample(20.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_HELD, 3)});         // from 0 s on
  trial.sample(23.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_BLOCKED_PERSON)});  // from 20 s on
  trial.sample(27.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_BLOCKED_ROBOT, 3)});
  trial.sample(28.0, {at(0, 0)});
  trial.sample(34.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_STUCK | DMRP_CLASS_CIRCLING)});
  trial.sample(35.0, {at(0, 0)}).events({becomes(0, DMRP_CLASS_SETTLING)});
  trial.sample(36.0, {at(0, 0, 0.0, parked)});  // the step of the arrival is active
  trial.sample(40.0, {at(0, 0, 0.0, parked)}).events({becomes(0, DMRP_CLASS_STUCK)});
  trial.end(40.0, {36.0});
  const Measurement m = measure("dmrp.metric.blocked_time", trial);
  CHECK(m.robot("held_time", 0) == 20.0);
  CHECK(m.robot("blocked_time_person", 0) == 3.0);
  CHECK(m.robot("blocked_time_robot", 0) == 5.0);
  CHECK(m.robot("blocked_time_stuck", 0) == 6.0);
  CHECK(m.system("blocked_time") == 14.0);
  CHECK(m.system("circling_time") == 6.0);
}

TEST_CASE("in a trace without the referee's classes its sums are undefined") {
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  fill(trial, 0.0, 40.0, [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0)}; });
  trial.end(40.0, {never, never}).failure(0, DMRP_FAILURE_STUCK);
  for (const char* id :
       {"dmrp.metric.blocked_time", "dmrp.metric.deadlock", "dmrp.metric.open_standstill", "dmrp.metric.first_cause"})
    for (const auto& [key, value] : measure(id, trial).values) {
      INFO(std::get<0>(key));
      CHECK(std::isnan(value));
    }
}

TEST_CASE("two robots that block each other are in deadlock") {
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  const auto stand = [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0)}; };
  const std::uint32_t of_first = GENERATE(DMRP_CLASS_BLOCKED_ROBOT, DMRP_CLASS_HELD);
  fill(trial, 0.0, 1.5, stand);
  trial.sample(2.0, stand(2.0)).events({becomes(0, of_first, 1), becomes(1, DMRP_CLASS_BLOCKED_ROBOT, 0)});
  fill(trial, 2.5, 12.0, stand);
  trial.end(12.0, {never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  CHECK(m.system("deadlocks") == 1.0);
  CHECK(m.system("deadlock_time") == 10.5);
  CHECK(m.robot("deadlocks", 0) == 1.0);
  CHECK(m.robot("deadlock_time", 1) == 10.5);
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].from_s == 1.5);
  CHECK(m.events[0].to_s == 12.0);
  CHECK(m.events[0].text == "robots 0 -> 1 -> 0 wait for each other");
  SECTION("not if it has to last longer") {
    CHECK(measure("dmrp.metric.deadlock", trial, {{"lasting_s", 10.6}}).system("deadlocks") == 0.0);
    CHECK(measure("dmrp.metric.deadlock", trial, {{"lasting_s", 10.5}}).system("deadlocks") == 1.0);
  }
}

TEST_CASE("three robots form a deadlock, without a fourth one that waits for them") {
  SyntheticTrial trial = standing({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {{1, 0}, {1, 0}, {1, 0}, {1, 0}});
  const auto stand = [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(1, 0), at(2, 0), at(3, 0)}; };
  trial.sample(0.0, stand(0.0))
      .events({becomes(0, DMRP_CLASS_BLOCKED_ROBOT, 1), becomes(1, DMRP_CLASS_BLOCKED_ROBOT, 2),
               becomes(2, DMRP_CLASS_HELD, 0), becomes(3, DMRP_CLASS_HELD, 0)});
  fill(trial, 0.5, 10.0, stand);
  trial.end(10.0, {never, never, never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  CHECK(m.system("deadlocks") == 1.0);
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(m.robot("deadlocks", 3) == 0.0);
  CHECK(m.robot("deadlock_time", 3) == 0.0);
}

TEST_CASE("no deadlock: one-sided waiting, a parked robot, a robot that is stuck") {
  const std::uint32_t of_second = GENERATE(DMRP_CLASS_MOVING, DMRP_CLASS_STUCK, DMRP_CLASS_BLOCKED_ROBOT);
  const std::uint32_t state = of_second == DMRP_CLASS_BLOCKED_ROBOT ? parked : DMRP_ROBOT_ACTIVE;
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  const auto stand = [&](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0, 0.0, state)}; };
  trial.sample(0.0, stand(0.0)).events({becomes(0, DMRP_CLASS_BLOCKED_ROBOT, 1), becomes(1, of_second, 0)});
  fill(trial, 0.5, 20.0, stand);
  trial.end(20.0, {never, never});
  CHECK(measure("dmrp.metric.deadlock", trial).system("deadlocks") == 0.0);
}

TEST_CASE("a deadlock that dissolves and returns counts twice") {
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  const auto stand = [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0)}; };
  trial.sample(0.0, stand(0.0)).events({becomes(0, DMRP_CLASS_BLOCKED_ROBOT, 1), becomes(1, DMRP_CLASS_HELD, 0)});
  fill(trial, 0.5, 13.5, stand);
  trial.sample(14.0, stand(14.0)).events({becomes(0, DMRP_CLASS_MOVING)});
  fill(trial, 14.5, 15.5, stand);
  trial.sample(16.0, stand(16.0)).events({becomes(0, DMRP_CLASS_BLOCKED_ROBOT, 1)});
  fill(trial, 16.5, 30.0, stand);
  trial.end(30.0, {never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  CHECK(m.system("deadlocks") == 2.0);
  CHECK(m.system("deadlock_time") == 13.5 + 14.5);  // (0, 13.5] and (15.5, 30]
}

TEST_CASE("neighbours is the time average of the count among all robots, while active") {
  SyntheticTrial trial(3);
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(0, 0), at(0, 0)});
  trial.sample(1.0, {at(0, 0), at(2, 0), at(4.5, 0, 0.0, parked)});             // 0: 1, 1: 1, 2: 0
  trial.sample(4.0, {at(0, 0), at(1, 0, 0.0, parked), at(1, 1, 0.0, parked)});  // 0: 2, 1: 2
  trial.sample(5.0, {at(0, 0), at(9, 0, 0.0, parked), at(9, 9, 0.0, parked)});  // 0: 0
  trial.end(5.0, {never, 4.0, 1.0});
  const Measurement m = measure("dmrp.metric.neighbours", trial);
  CHECK(m.robot("neighbours", 0) == 1.4);   // (1 * 1 + 3 * 2) / 5
  CHECK(m.robot("neighbours", 1) == 1.75);  // (1 * 1 + 3 * 2) / 4
  CHECK(m.robot("neighbours", 2) == 0.0);
  CHECK(m.system("neighbours") == Approx(1.05));
}

TEST_CASE("a failed robot before which a person stood for ten seconds is a stand-off") {
  const double standing_s = GENERATE(9.0, 11.0);
  const double desired_speed = GENERATE(0.0, 1.2);
  SyntheticTrial trial(3);
  for (double t = 0.0; t <= 30.0; t += 0.5) {
    trial.sample(t, {at(0, 0), at(5, 0), at(10, 0)});
    dmrp_person waiting{};
    waiting.id = 7;
    waiting.desired_speed = desired_speed;
    waiting.position = {t <= standing_s ? 1.2 + 0.01 * t : 9.0, 0.0};  // then near the robot that arrives
    trial.crowd({waiting});
  }
  trial.end(30.0, {never, never, 30.0});
  const Measurement m = measure("dmrp.metric.person_standoff", trial);
  const bool is_standoff = standing_s > 10.0 && desired_speed > 0.0;
  CHECK(m.robot("person_standoff", 0) == (is_standoff ? 1.0 : 0.0));
  CHECK(m.robot("person_standoff", 1) == 0.0);
  CHECK(std::isnan(m.robot("person_standoff", 2)));
  CHECK(m.system("person_standoff") == (is_standoff ? 0.5 : 0.0));
  if (!is_standoff) return;
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].text == "robot 0 and person 7 stand before each other");
  CHECK(m.events[0].to_s == 10.0);  // farther than 1.3 m then
}

TEST_CASE("a robot that stands though nobody is in its way is counted") {
  const double until_s = GENERATE(15.0, 14.0);
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {9, 0}}, {{0, 50}, {9, 50}}});
  const std::vector<dmrp_robot_sample> robots = {at(0, 0), at(5, 50)};
  trial.sample(0.0, robots).events({becomes(0, DMRP_CLASS_MOVING), becomes(1, DMRP_CLASS_STUCK | DMRP_CLASS_CIRCLING)});
  trial.sample(1.0, robots).events({becomes(0, DMRP_CLASS_STUCK)});
  trial.sample(until_s, robots);
  trial.sample(until_s + 1.0, robots).events({becomes(0, DMRP_CLASS_BLOCKED_PERSON)});
  trial.sample(until_s + 2.0, robots).events({becomes(0, DMRP_CLASS_STUCK)});
  trial.sample(until_s + 3.0, robots);
  trial.end(until_s + 3.0, {never, never});
  const Measurement m = measure("dmrp.metric.open_standstill", trial);
  CHECK(m.robot("open_standstills", 0) == (until_s == 15.0 ? 1.0 : 0.0));
  CHECK(m.robot("open_standstills", 1) == 0.0);  // it circles
  CHECK(m.system("open_standstills") == (until_s == 15.0 ? 1.0 : 0.0));
  if (until_s < 15.0) return;
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].from_s == 0.0);
  CHECK(m.events[0].to_s == 15.0);
  CHECK(m.events[0].text == "robot 0 stands although nobody is in its way");
}

TEST_CASE("a mini-game's robots wait for each other, change their velocity and flow through") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {3, 0}}, {{0, 1}, {3, 1}}});
  const auto moving = [](double x, double y, double heading, double v_x, std::uint32_t state = DMRP_ROBOT_ACTIVE) {
    dmrp_robot_sample sample = at(x, y, v_x, state);
    sample.pose.theta = heading;
    return sample;
  };
  trial.sample(0.0, {moving(0, 0, 0, 0.0), moving(0, 1, 0, 0.0)});
  trial.sample(2.0, {moving(1, 0, 0, 0.5), moving(0, 1, 0, 0.5)});
  trial.sample(4.0, {moving(2, 0, dmrp::toolkit::pi / 2, 0.5), moving(1, 1, 0, 0.5)});  // turns: sqrt(0.5)
  trial.sample(5.0, {moving(3, 0, dmrp::toolkit::pi / 2, 0.0, parked), moving(2, 1, 0, 0.5)});
  trial.sample(8.0, {moving(3, 0, 0.0, 0.0, parked), moving(3, 1, 0, 0.5, parked)});
  trial.end(8.0, {5.0, 8.0});
  const Measurement m = measure("dmrp.metric.mini_game", trial);
  CHECK(m.robot("makespan_ratio", 0) == 1.0);
  CHECK(m.robot("makespan_ratio", 1) == 1.6);
  CHECK(m.system("makespan_ratio") == 1.6);
  CHECK_THAT(m.robot("velocity_change", 0), WithinAbs(0.5 + std::sqrt(0.5) + 0.5, 1e-12));
  CHECK_THAT(m.robot("velocity_change", 1), WithinAbs(0.5, 1e-12));
  CHECK(m.system("flow_rate") == 2.0 / 8.0);
  CHECK(measure("dmrp.metric.mini_game", trial, {{"gap_width_m", 0.5}}).system("flow_rate") == 2.0 / (0.5 * 8.0));

  trial.end(8.0, {5.0, never});
  const Measurement stuck = measure("dmrp.metric.mini_game", trial);
  CHECK(stuck.system("flow_rate") == 0.0);
  CHECK(std::isnan(stuck.system("makespan_ratio")));
  CHECK(stuck.robot("makespan_ratio", 0) == 1.0);
}

}  // namespace interaction_test
