// SPDX-License-Identifier: MIT
// Collisions: events, not samples; attributed; whole on the time line.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace collisions_test {

using namespace dmrp::test;

constexpr std::uint32_t with_static = DMRP_CONTACT_STATIC;
constexpr std::uint32_t with_robot = DMRP_CONTACT_ROBOT;
constexpr std::uint32_t with_person = DMRP_CONTACT_PERSON;

TEST_CASE("a lasting contact is one collision, from its first to its last sample") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  trial.sample(0.1, {at(0, 0)}).contacts({contact(with_static, 0, 0, begins | fault_a)});
  trial.sample(0.2, {at(0, 0)}).contacts({contact(with_static, 0, 0, fault_a)});
  trial.sample(0.3, {at(0, 0)});                                                           // apart for less than 0.5 s:
  trial.sample(0.4, {at(0, 0)}).contacts({contact(with_static, 0, 0, fault_a)});           // still the same
  trial.sample(2.0, {at(0, 0)}).contacts({contact(with_static, 0, 0, begins | fault_a)});  // a new one, open at the end
  trial.end(2.0, {never});

  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 2.0);
  CHECK(m.system("collisions_at_fault") == 2.0);
  CHECK(m.system("collisions_static") == 2.0);
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].name == "collisions");
  CHECK(m.events[0].from_s == 0.1);
  CHECK(m.events[0].to_s == 0.4);
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{0});
  CHECK(m.events[0].text == "robot 0 against shelf B");
  CHECK(m.events[1].from_s == 2.0);
  CHECK(m.events[1].to_s == 2.0);
}

TEST_CASE("contacts of a kind that a metric does not know are skipped") {
  constexpr std::uint32_t unknown = 77;
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  trial.sample(0.1, {at(0, 0)}).contacts({contact(unknown, 5, 0, begins | fault_a)});
  trial.end(0.1);
  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 0.0);
  CHECK(m.events.empty());
  CHECK(measure("dmrp.metric.success", trial).system("safe_success") == 1.0);
}

TEST_CASE("collisions count for each robot and once for the system") {
  const std::vector<dmrp_robot_sample> robots = {at(0, 0), at(0, 0), at(0, 0)};
  SyntheticTrial trial(3);
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}}).sample(0.0, robots);
  trial.sample(1.0, robots)
      .contacts({
          contact(with_static, 2, 1, begins | fault_a),           // 2 against the border (index shape_count)
          contact(with_robot, 0, 1, begins | fault_a | fault_b),  // head-on
          contact(with_robot, 0, 2, begins | fault_b),            // 2 into 0
          contact(with_robot, 1, 2, begins),                      // pushed together by somebody else
      });
  trial.end(1.0);

  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 4.0);
  CHECK(m.system("collisions_at_fault") == 3.0);  // all but the last
  CHECK(m.system("collisions_static") == 1.0);
  CHECK(m.system("collisions_robot") == 3.0);
  CHECK(m.system("collisions_person") == 0.0);
  CHECK(m.robot("collisions", 0) == 2.0);  // with 1, with 2
  CHECK(m.robot("collisions", 1) == 2.0);  // with 0, with 2
  CHECK(m.robot("collisions", 2) == 3.0);  // border, 0, 1
  CHECK(m.robot("collisions_at_fault", 0) == 1.0);
  CHECK(m.robot("collisions_at_fault", 1) == 1.0);
  CHECK(m.robot("collisions_at_fault", 2) == 2.0);
  CHECK(m.robot("collisions_static", 2) == 1.0);
  CHECK(m.robot("collisions_robot", 2) == 2.0);
  REQUIRE(m.events.size() == 4);
  CHECK(m.events[0].text == "robot 2 against the border");
  CHECK(m.events[1].text == "robot 0 and robot 1: both at fault");
  CHECK(m.events[1].robots == std::vector<std::uint32_t>{0, 1});
  CHECK(m.events[2].text == "robot 0 and robot 2: robot 2 at fault");
  CHECK(m.events[3].text == "robot 1 and robot 2: neither at fault");
}

TEST_CASE("contacts with people have a fault") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).people({7, 8, 9, 10});
  trial.sample(1.0, {at(0, 0)})
      .people({7, 8, 9, 10})
      .contacts({
          contact(with_person, 0, 0, begins | fault_a),            // the robot's
          contact(with_person, 0, 1, begins | fault_b),            // the person's
          contact(with_person, 0, 2, begins | fault_a | fault_b),  // both drove and walked into each other
          contact(with_person, 0, 3, begins),                      // both stood: somebody pushed the person
      });
  trial.end(1.0);

  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 4.0);
  CHECK(m.system("collisions_person") == 4.0);
  CHECK(m.system("collisions_at_fault") == 2.0);
  CHECK(m.robot("collisions", 0) == 4.0);
  CHECK(m.robot("collisions_at_fault", 0) == 2.0);
  REQUIRE(m.events.size() == 4);
  CHECK(m.events[0].text == "robot 0 and person 7: robot 0 at fault");
  CHECK(m.events[1].text == "robot 0 and person 8: person 8 at fault");
  CHECK(m.events[2].text == "robot 0 and person 9: both at fault");
  CHECK(m.events[3].text == "robot 0 and person 10: neither at fault");
}

TEST_CASE("the impact speed is the greatest of a robot's events") {
  const auto at_speed = [](std::uint32_t kind, std::uint32_t a, std::uint32_t b, double speed) {
    dmrp_contact made = contact(kind, a, b, begins | fault_a);
    made.impact_speed = speed;
    return made;
  };
  SyntheticTrial trial(3);
  const std::vector<dmrp_robot_sample> robots(3, at(0, 0));
  trial.plan({{{0, 0}}, {{0, 0}}, {{0, 0}}}).sample(0.0, robots);
  trial.sample(1.0, robots).contacts({at_speed(with_static, 0, 0, 0.3), at_speed(with_robot, 0, 1, 0.5)});
  trial.sample(2.0, robots).contacts({at_speed(with_static, 0, 0, 0.2)});
  trial.end(2.0);
  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.robot("impact_speed", 0) == 0.5);
  CHECK(m.robot("impact_speed", 1) == 0.5);
  CHECK(std::isnan(m.robot("impact_speed", 2)));
  CHECK(m.system("impact_speed") == 0.5);
}

TEST_CASE("contacts follow people whose indices change") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).people({7, 8});
  trial.sample(1.0, {at(0, 0)})
      .people({7, 8})
      .contacts({
          contact(with_person, 0, 0, begins | fault_a),  // 7
          contact(with_person, 0, 1, begins | fault_b),  // 8
      });
  trial.sample(2.0, {at(0, 0)}).people({8, 9}).contacts({contact(with_person, 0, 0, fault_b)});  // 8 again
  trial.end(2.0);

  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 2.0);
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].to_s == 1.0);  // 7
  CHECK(m.events[1].to_s == 2.0);  // 8
}

TEST_CASE("without a plan the number of collisions is undefined") {
  SyntheticTrial trial(2);
  trial.end(0.0, {never, never});
  const Measurement m = measure("dmrp.metric.collisions", trial);
  for (const auto& [key, value] : m.values) CHECK(std::isnan(value));
  CHECK(m.values.size() == 18);
}

TEST_CASE("a trial without contacts has 0 collisions") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{3, 0}}}).sample(0.0, {at(0, 0), at(3, 0)}).sample(1.0, {at(0, 0), at(3, 0)}).end(1.0);
  const Measurement m = measure("dmrp.metric.collisions", trial);
  for (const auto& [key, value] : m.values)
    if (std::get<0>(key) == "impact_speed")
      CHECK(std::isnan(value));  // nothing to measure
    else
      CHECK(value == 0.0);
  CHECK(m.values.size() == 18);  // 6 names for the system and 2 robots
  CHECK(m.events.empty());
}

}  // namespace collisions_test
