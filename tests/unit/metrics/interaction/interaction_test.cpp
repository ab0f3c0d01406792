// SPDX-License-Identifier: MIT
// Blocked time, deadlock and neighbours: cases computed by hand.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "tests/unit/metrics/synthetic_trial.hpp"

using namespace dmrp::test;

namespace {

constexpr std::uint32_t parked = DMRP_ROBOT_FINISHED;

dmrp_robot_sample gained(dmrp_robot_sample robot, double progress_m) {
  robot.progress_m = progress_m;
  return robot;
}

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

}  // namespace

TEST_CASE("blocked time is the time without progress between the first motion and the arrival") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {9, 0}}});
  fill(trial, 0.0, 20.0, [](double t) -> std::vector<dmrp_robot_sample> {
    if (t <= 5.0) return {at(0, 0)};                             // waits for its start
    if (t <= 7.0) return {gained(at(0, 0, 1.0), t - 5.0)};       // 1 m/s
    if (t <= 11.0) return {gained(at(0, 0), 2.0)};               // blocked: (7, 11]
    if (t <= 13.0) return {gained(at(0, 0, 1.0), t - 9.0)};      // 1 m/s
    if (t <= 14.5) return {gained(at(0, 0), 4.0)};               // 1.5 s: shorter than the window
    if (t <= 15.0) return {gained(at(0, 0, 1.0, parked), 4.5)};  // arrives
    return {gained(at(0, 0, 0.0, parked), 4.5)};
  });
  trial.end(20.0, {15.0});
  CHECK(measure("dmrp.metric.blocked_time", trial).system("blocked_time") == 4.0);
  SECTION("with a shorter window the short stop counts as well") {
    CHECK(measure("dmrp.metric.blocked_time", trial, {{"window_s", 1.0}}).system("blocked_time") == 5.5);
  }
}

TEST_CASE("a new path is neither progress nor a loss of progress") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {9, 0}}});
  fill(trial, 0.0, 2.0, [](double t) -> std::vector<dmrp_robot_sample> { return {gained(at(0, 0, 1.0), t)}; });
  trial.plan({{{2, 0}, {9, 0}}});  // standing still, progress begins at 0 again
  fill(trial, 2.5, 4.0, [](double) -> std::vector<dmrp_robot_sample> { return {gained(at(0, 0), 0.0)}; });
  trial.plan({{{0, 0}, {9, 0}}});  // and is 2 again
  fill(trial, 4.5, 6.0, [](double) -> std::vector<dmrp_robot_sample> { return {gained(at(0, 0), 2.0)}; });
  trial.end(6.0, {never});
  CHECK(measure("dmrp.metric.blocked_time", trial).system("blocked_time") == 4.0);
}

TEST_CASE("blocked time is 0 for a robot that creeps and for one that never moves") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {9, 0}}, {{0, 5}, {9, 5}}});
  fill(trial, 0.0, 10.0, [](double t) -> std::vector<dmrp_robot_sample> {
    return {gained(at(0, 0, 0.06), 0.06 * t), at(0, 5)};
  });
  trial.end(10.0, {never, never});
  const Measurement m = measure("dmrp.metric.blocked_time", trial);
  CHECK(m.robot("blocked_time", 0) == 0.0);  // 0.12 m in a window
  CHECK(m.robot("blocked_time", 1) == 0.0);
}

TEST_CASE("two robots that stand head-on are in deadlock") {
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  fill(trial, 0.0, 12.0, [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0)}; });
  trial.end(12.0, {never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  // both wait once a window of 2 s was watched: in the step that ends at 2 s, up to the end
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
  // 0, 1 and 2 at the corners of a triangle with sides of 0.8 m, each heading for the next; 3 heads for 0 from behind
  const double half = 0.5, height = std::sqrt(0.75);
  SyntheticTrial trial = standing({{0, 0}, {0.8, 0}, {0.8 * half, 0.8 * height}, {-0.8, 0}},
                                  {{1, 0}, {-half, height}, {-half, -height}, {1, 0}});
  fill(trial, 0.0, 10.0, [&](double) -> std::vector<dmrp_robot_sample> {
    return {at(0, 0), at(0.8, 0), at(0.8 * half, 0.8 * height), at(-0.8, 0)};
  });
  trial.end(10.0, {never, never, never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  CHECK(m.system("deadlocks") == 1.0);
  REQUIRE(m.events.size() == 1);
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{0, 1, 2});
  CHECK(m.robot("deadlocks", 3) == 0.0);
  CHECK(m.robot("deadlock_time", 3) == 0.0);
}

TEST_CASE("no deadlock: one-sided waiting, a parked robot, a free way, a moving robot") {
  const std::vector<dmrp_vec2> places = {{0, 0}, {0.7, 0}};
  const auto deadlocks = [](SyntheticTrial& trial, const std::function<std::vector<dmrp_robot_sample>(double)>& as) {
    fill(trial, 0.0, 20.0, as);
    trial.end(20.0, {never, never});
    return measure("dmrp.metric.deadlock", trial).system("deadlocks");
  };
  const auto both_stand = [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(0.7, 0)}; };
  SECTION("both eastward") {
    SyntheticTrial trial = standing(places, {{1, 0}, {1, 0}});
    CHECK(deadlocks(trial, both_stand) == 0.0);
  }
  SECTION("apart") {
    SyntheticTrial trial = standing(places, {{-1, 0}, {1, 0}});
    CHECK(deadlocks(trial, both_stand) == 0.0);
  }
  SECTION("one is parked in the way of the other") {
    SyntheticTrial trial = standing(places, {{1, 0}, {-1, 0}});
    CHECK(deadlocks(trial, [](double) -> std::vector<dmrp_robot_sample> {
            return {at(0, 0), at(0.7, 0, 0.0, parked)};
          }) == 0.0);
  }
  SECTION("one gets on") {
    SyntheticTrial trial = standing(places, {{1, 0}, {-1, 0}});
    CHECK(deadlocks(trial, [](double t) -> std::vector<dmrp_robot_sample> {
            return {at(0, 0), gained(at(0.7, 0, 0.1), 0.1 * t)};
          }) == 0.0);
  }
  SECTION("too far ahead") {
    SyntheticTrial trial = standing({{0, 0}, {1.7, 0}}, {{1, 0}, {-1, 0}});
    CHECK(deadlocks(trial, [](double) -> std::vector<dmrp_robot_sample> { return {at(0, 0), at(1.7, 0)}; }) == 0.0);
  }
}

TEST_CASE("a deadlock that dissolves and returns counts twice") {
  SyntheticTrial trial = standing({{0, 0}, {0.7, 0}}, {{1, 0}, {-1, 0}});
  fill(trial, 0.0, 30.0, [](double t) -> std::vector<dmrp_robot_sample> {
    const double progress_m = t < 14.0 ? 0.0 : 0.5;  // robot 0 jumps ahead once
    return {gained(at(0, 0), progress_m), at(0.7, 0)};
  });
  trial.end(30.0, {never, never});
  const Measurement m = measure("dmrp.metric.deadlock", trial);
  CHECK(m.system("deadlocks") == 2.0);
  // (1.5, 13.5] and, a whole window after the jump's last sample before it (13.5), (15.5, 30]
  CHECK(m.system("deadlock_time") == 12.0 + 14.5);
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

TEST_CASE("a robot that stands in the open with its way free is counted") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {9, 0}}, {{0, 50}, {9, 50}}});
  const auto stand = [&trial](double until_s) {
    for (double t = 0.0; t <= until_s; t += 0.5) trial.sample(t, {at(0, 0), gained(at(t, 50, 1.0), t)});
    trial.end(until_s, {never, until_s});
    return measure("dmrp.metric.open_standstill", trial);
  };
  const auto of_first = [&](double until_s) { return stand(until_s).robot("open_standstills", 0); };
  SECTION("for fifteen seconds and more") {
    const Measurement m = stand(20.0);
    CHECK(m.robot("open_standstills", 0) == 1.0);
    CHECK(m.robot("open_standstills", 1) == 0.0);
    CHECK(m.system("open_standstills") == 1.0);
    REQUIRE(m.events.size() == 1);
    CHECK(m.events[0].from_s == 1.0);
    CHECK(m.events[0].to_s == 20.0);
  }
  SECTION("not for a shorter time") {
    CHECK(of_first(15.0) == 0.0);
  }
  SECTION("not beside a wall") {
    trial.box("wall", {-1, 0.7}, {1, 0.8});
    CHECK(of_first(20.0) == 0.0);
  }
  SECTION("with a way past an obstacle on the path") {
    trial.box("table", {1.5, -0.4}, {2.0, 0.4});
    CHECK(of_first(20.0) == 1.0);
  }
  SECTION("not before a gap that is narrower than the robot") {
    trial.box("left", {1.5, 0.2}, {2.0, 3.0}).box("right", {1.5, -3.0}, {2.0, -0.2});
    CHECK(of_first(20.0) == 0.0);
  }
}

TEST_CASE("a person in the way or nearby is a reason to stand") {
  for (const dmrp_vec2 place : {dmrp_vec2{3.0, 0.0}, dmrp_vec2{0.0, 0.9}}) {
    SyntheticTrial trial(1);
    trial.plan({{{0, 0}, {9, 0}}});
    for (double t = 0.0; t <= 20.0; t += 0.5) {
      dmrp_person person{};
      person.position = place;
      person.radius_m = 0.3;
      trial.sample(t, {at(0, 0)}).crowd({person});
    }
    trial.end(20.0, {never});
    CHECK(measure("dmrp.metric.open_standstill", trial).system("open_standstills") == 0.0);
  }
}
