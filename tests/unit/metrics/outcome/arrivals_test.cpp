// SPDX-License-Identifier: MIT
// ISR, CSR, flowtime, makespan, throughput, SPL and first causes: cases computed by hand.
#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace arrivals_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

const double free_heading = std::nan("");

dmrp_robot_sample heading_for(std::uint32_t goal_index) {
  dmrp_robot_sample robot = at(0, 0);
  robot.goal_index = goal_index;
  return robot;
}

TEST_CASE("flowtime is the sum, makespan the maximum of arrivals") {
  SyntheticTrial trial(3);
  trial.plan({{{0, 0}}, {{3, 0}}, {{6, 0}}}).sample(0.0, {at(0, 0), at(3, 0), at(6, 0)});
  SECTION("all arrive") {
    trial.end(10.0, {4.0, 10.0, 6.5});
    const Measurement m = measure("dmrp.metric.arrivals", trial);
    CHECK(m.system("isr") == 1.0);
    CHECK(m.system("csr") == 1.0);
    CHECK(m.system("flowtime") == 20.5);
    CHECK(m.system("makespan") == 10.0);
  }
  SECTION("one does not: only the shares are defined") {
    trial.end(20.0, {4.0, never, 6.5});
    const Measurement m = measure("dmrp.metric.arrivals", trial);
    CHECK(m.robot("isr", 0) == 1.0);
    CHECK(m.robot("isr", 1) == 0.0);
    CHECK_THAT(m.system("isr"), WithinAbs(2.0 / 3.0, 1e-15));
    CHECK(m.system("csr") == 0.0);
    CHECK(std::isnan(m.system("flowtime")));
    CHECK(std::isnan(m.system("makespan")));
  }
  SECTION("a robot that oscillated is at its goal all the same") {
    trial.end(10.0, {4.0, 10.0, 6.5}).failure(1, DMRP_FAILURE_OSCILLATION);
    CHECK(measure("dmrp.metric.arrivals", trial).system("csr") == 1.0);
    CHECK(measure("dmrp.metric.success", trial).system("trial_success") == 0.0);
  }
}

TEST_CASE("throughput counts every goal of a tour") {
  SyntheticTrial trial(3);
  const std::vector<dmrp_pose> tour = {{1, 0, free_heading}, {2, 0, free_heading}, {3, 0, free_heading}};
  for (std::size_t robot = 0; robot < 3; ++robot) trial.route(robot, {0, 0, 0}, tour);
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {heading_for(0), heading_for(0), heading_for(0)});
  trial.sample(20.0, {heading_for(2), heading_for(2), heading_for(0)});
  trial.end(20.0, {20.0, never, never});  // robot 0 reached three, robot 1 two, robot 2 none
  const Measurement m = measure("dmrp.metric.arrivals", trial);
  CHECK(m.robot("throughput", 0) == 0.15);
  CHECK(m.robot("throughput", 1) == 0.1);
  CHECK(m.robot("throughput", 2) == 0.0);
  CHECK_THAT(m.system("throughput"), WithinAbs(0.25, 1e-15));
}

TEST_CASE("SPL weights success by the shortest length over the driven one") {
  SyntheticTrial trial(3);
  for (std::size_t robot = 0; robot < 3; ++robot) trial.route(robot, {0, 0, 0}, {{3, 4, free_heading}});
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(0, 0), at(0, 0)});
  trial.sample(1.0, {at(3, 0), at(-3, 0), at(3, 0)});
  trial.sample(2.0, {at(3, 4), at(-3, 4), at(3, 3)});
  trial.sample(3.0, {at(3, 4), at(3, 4), at(3, 3)});
  trial.end(3.0, {2.0, 3.0, never});
  const Measurement m = measure("dmrp.metric.spl", trial);
  CHECK_THAT(m.robot("spl", 0), WithinAbs(5.0 / 7.0, 1e-15));
  CHECK_THAT(m.robot("spl", 1), WithinAbs(5.0 / 13.0, 1e-15));
  CHECK(m.robot("spl", 2) == 0.0);  // no success, however short
  CHECK_THAT(m.system("spl"), WithinAbs((5.0 / 7.0 + 5.0 / 13.0) / 3.0, 1e-15));
  CHECK(m.system("shortest_length") == 15.0);
}

TEST_CASE("SPL is at most 1: a robot that stops within its goal's tolerance drives less than the shortest way") {
  SyntheticTrial trial(1);
  trial.route(0, {0, 0, 0}, {{5, 0, free_heading}}).plan({{{0, 0}}});
  trial.sample(0.0, {at(0, 0)}).sample(1.0, {at(4.9, 0)}).end(1.0);
  CHECK(measure("dmrp.metric.spl", trial).system("spl") == 1.0);
}

TEST_CASE("SPL of a robot that starts at its goal is 1") {
  SyntheticTrial trial(1);
  trial.route(0, {1, 1, 0}, {{1, 1, free_heading}}).plan({{{1, 1}}});
  trial.sample(0.0, {at(1, 1)}).end(0.5);
  CHECK(measure("dmrp.metric.spl", trial).system("spl") == 1.0);
}

TEST_CASE("the shortest way leads past walls through all goals of a tour; its definition is tested by itself") {
  SyntheticTrial trial(1);
  trial.bounds({0, 0}, {7, 5}).box("wall", {3, 0}, {4, 4});
  trial.plan({{{1, 1}}}).sample(0.0, {at(1, 1)}).end(1.0, {never});
  const auto length = [&] { return measure("dmrp.metric.spl", trial).system("shortest_length"); };
  SECTION("a tour there and back") {
    trial.route(0, {0.5, 0.5, 0}, {{2.5, 0.5, free_heading}, {0.5, 0.5, free_heading}, {0.5, 3.25, free_heading}});
    CHECK(length() == 6.75);
  }
  SECTION("round the wall") {
    trial.route(0, {1.0, 4.25, 0}, {{6.0, 4.25, free_heading}});
    CHECK(length() == 5.0);
  }
  SECTION("no way") {
    trial.box("door", {3, 4}, {4, 4.6}).route(0, {1.0, 1.0, 0}, {{6.0, 1.0, free_heading}});
    CHECK(std::isnan(length()));
  }
}

TEST_CASE("success_at counts the robots that succeed within multiples of their least time") {
  SyntheticTrial trial(4);  // 8 m at 0.8 m/s
  for (std::size_t robot = 0; robot < 4; ++robot) trial.route(robot, {0, 0, 0}, {{8, 0, free_heading}});
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}, {{0, 0}}});
  trial.end(40.0, {15.0, 15.1, 20.0, 30.0}).failure(3, DMRP_FAILURE_OSCILLATION);
  const Measurement m = measure("dmrp.metric.spl", trial);
  CHECK(m.curves.at("success_at") == std::map<double, double>{{1.5, 0.25}, {2.0, 0.75}, {3.0, 0.75}});
}

TEST_CASE("after a standstill that runs on, it counts which of its robots arrive") {
  SyntheticTrial trial(3);
  trial.plan(std::vector<Points>(3, Points{{0, 0}})).sample(0.0, std::vector<dmrp_robot_sample>(3, at(0, 0)));
  const bool runs_on = GENERATE(true, false);
  if (runs_on)
    trial.events({{DMRP_ROBOT_EVENT_RUNS_ON, 0, 0, 0, DMRP_NOBODY}, {DMRP_ROBOT_EVENT_RUNS_ON, 2, 0, 0, DMRP_NOBODY}});
  trial.end(40.0, {never, 10.0, 35.0});
  const Measurement m = measure("dmrp.metric.first_cause", trial);
  CHECK(std::isnan(m.robot("after_standstill", 1)));
  if (!runs_on) {
    CHECK(std::isnan(m.system("after_standstill")));
    return;
  }
  CHECK(m.robot("after_standstill", 0) == 0.0);
  CHECK(m.robot("after_standstill", 2) == 1.0);
  CHECK(m.system("after_standstill") == 0.5);
}

TEST_CASE("a robot that stands after a contact failed by the contact") {
  constexpr double collision = 100.0;
  SyntheticTrial trial(8);
  const std::vector<dmrp_robot_sample> robots(8, at(0, 0));
  const std::uint32_t moving = DMRP_CLASS_MOVING, stuck = DMRP_CLASS_STUCK;
  trial.plan(std::vector<Points>(8, Points{{0, 0}}));
  std::vector<dmrp_robot_event> all;
  for (std::uint32_t robot = 0; robot < 8; ++robot) all.push_back(becomes(robot, moving));
  trial.sample(0.0, robots).events(all);
  // 0 and 1 into each other, to their end; 2 against a wall, once; 3 likewise, but it drives on; 4 was stuck before
  trial.sample(10.0, robots)
      .contacts({contact(DMRP_CONTACT_ROBOT, 0, 1, begins | fault_a),
                 contact(DMRP_CONTACT_STATIC, 2, 0, begins | fault_a), contact(DMRP_CONTACT_STATIC, 3, 0, begins)})
      .events({becomes(4, stuck), becomes(7, stuck)});
  trial.sample(12.0, robots)
      .contacts({contact(DMRP_CONTACT_ROBOT, 0, 1, 0), contact(DMRP_CONTACT_PERSON, 4, 0, begins)});
  trial.sample(29.0, robots)
      .contacts({contact(DMRP_CONTACT_ROBOT, 0, 1, 0)})
      .events({becomes(0, stuck), becomes(1, stuck), becomes(2, stuck)});
  trial.sample(55.0, robots).contacts({contact(DMRP_CONTACT_ROBOT, 0, 1, 0)});
  trial.sample(60.0, robots)
      .contacts({contact(DMRP_CONTACT_ROBOT, 0, 1, 0), contact(DMRP_CONTACT_PERSON, 5, 0, begins),
                 contact(DMRP_CONTACT_PERSON, 7, 0, begins)})  // 7 was stuck before
      .events({becomes(3, stuck)});
  trial.end(60.0, std::vector<double>(8, never));
  trial.failure(0, DMRP_FAILURE_BLOCKED_ROBOT, 1).failure(1, DMRP_FAILURE_BLOCKED_ROBOT, 0);
  trial.failure(2, DMRP_FAILURE_STUCK).failure(3, DMRP_FAILURE_STUCK).failure(4, DMRP_FAILURE_STUCK);
  trial.failure(6, DMRP_FAILURE_HELD_BEHIND, 0).failure(7, DMRP_FAILURE_STUCK);  // 5 touches at the time limit

  const Measurement m = measure("dmrp.metric.first_cause", trial);
  const std::vector<double> causes = {collision,          collision, collision, DMRP_FAILURE_STUCK,
                                      DMRP_FAILURE_STUCK, collision, collision, DMRP_FAILURE_STUCK};
  for (std::size_t robot = 0; robot < causes.size(); ++robot) CHECK(m.robot("first_cause", robot) == causes[robot]);
  CHECK(m.robot("culprit", 6) == 0.0);
  CHECK(m.system("first_cause") == collision);

  const Measurement success = measure("dmrp.metric.success", trial);
  REQUIRE(success.events.size() == 8);
  CHECK(success.events[0].text == "robot 0 failed: stood after hitting another robot");
  CHECK(success.events[0].robots == std::vector<std::uint32_t>{0});
  CHECK(success.events[1].text == "robot 1 failed: stood after another robot hit it");
  CHECK(success.events[2].text == "robot 2 failed: stood after hitting a wall or furniture");
  CHECK(success.events[3].text == "robot 3 failed: stuck");
  CHECK(success.events[5].text == "robot 5 failed: touched a person at its end");
  CHECK(success.events[6].text == "robot 6 failed: held behind another robot");
}

TEST_CASE("a robot that waits for another failed by the other's cause") {
  SyntheticTrial trial(6);
  trial.plan(std::vector<Points>(6, Points{{0, 0}})).sample(0.0, std::vector<dmrp_robot_sample>(6, at(0, 0)));
  trial.events({becomes(0, DMRP_CLASS_MOVING)});
  trial.end(40.0, {never, never, never, never, never, 30.0});
  trial.failure(0, DMRP_FAILURE_HELD_BEHIND, 2).failure(1, DMRP_FAILURE_HELD_BEHIND, 2);
  trial.failure(2, DMRP_FAILURE_BLOCKED_ROBOT, 5);
  trial.failure(3, DMRP_FAILURE_STUCK).failure(4, DMRP_FAILURE_HELD_BEHIND, 5);  // which arrived
  const Measurement m = measure("dmrp.metric.first_cause", trial);
  const std::vector<double> causes = {DMRP_FAILURE_BLOCKED_ROBOT, DMRP_FAILURE_BLOCKED_ROBOT,
                                      DMRP_FAILURE_BLOCKED_ROBOT, DMRP_FAILURE_STUCK, DMRP_FAILURE_HELD_BEHIND};
  for (std::size_t robot = 0; robot < causes.size(); ++robot) CHECK(m.robot("first_cause", robot) == causes[robot]);
  CHECK(m.robot("culprit", 0) == 2.0);
  CHECK(m.robot("culprit", 2) == 5.0);
  CHECK(std::isnan(m.robot("culprit", 3)));
  CHECK(m.robot("held_behind", 1) == 1.0);
  CHECK(m.robot("held_behind", 2) == 0.0);
  for (const char* name : {"first_cause", "culprit", "held_behind"}) CHECK(std::isnan(m.robot(name, 5)));
  CHECK(m.system("first_cause") == DMRP_FAILURE_BLOCKED_ROBOT);
  CHECK(m.system("culprit") == 2.0);  // as often as 5
  CHECK(m.system("held_behind") == 3.0);
  SECTION("the event of its failure names both") {
    const Measurement success = measure("dmrp.metric.success", trial);
    REQUIRE(success.events.size() == 5);
    CHECK(success.events[0].robots == std::vector<std::uint32_t>{0, 2});
    CHECK(success.events[0].text == "robot 0 failed: held behind another robot");
    CHECK(success.events[3].robots == std::vector<std::uint32_t>{3});
  }
}

}  // namespace arrivals_test
