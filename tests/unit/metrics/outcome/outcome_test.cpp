// SPDX-License-Identifier: MIT
// Success, path length, planning time, completion time, speed: cases computed by hand.

#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace outcome_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

TEST_CASE("success is the share of robots that arrived and were not failed") {
  SyntheticTrial trial(4);
  trial.plan({{{0, 0}}, {{3, 0}}, {{6, 0}}, {{9, 0}}});
  trial.sample(0.0, {at(0, 0), at(3, 0), at(6, 0), at(9, 0)});
  // arrived; not in time; arrived after it had oscillated, which counts as failed; arrived
  trial.end(10.0, {4.0, never, 9.0, 10.0}).failure(2, DMRP_FAILURE_OSCILLATION);

  const Measurement m = measure("dmrp.metric.success", trial);
  CHECK(m.robot("success", 0) == 1.0);
  CHECK(m.robot("success", 1) == 0.0);
  CHECK(m.robot("success", 2) == 0.0);
  CHECK(m.robot("success", 3) == 1.0);
  CHECK(m.system("success") == 0.5);  // 2 of 4
  CHECK(m.system("trial_success") == 0.0);
  CHECK(m.system("safe_success") == 0.5);

  // the time line says why the others failed
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].text == "robot 1 failed: time limit");
  CHECK(m.events[0].robots == std::vector<std::uint32_t>{1});
  CHECK(m.events[0].from_s == 10.0);
  CHECK(m.events[1].text == "robot 2 failed: excluded for oscillation");
}

TEST_CASE("people nearby is the time average of the count around active robots") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{20, 0}}});
  trial.sample(0.0, {at(0, 0), at(20, 0)}).people_at({{3, 4}, {0, 5.1}});  // stands for no time
  trial.sample(1.0, {at(0, 0), at(20, 0)})
      .people_at({{3, 4}, {0, 5.1}});  // 1 s: robot 0 has one (at 5 m), robot 1 none
  trial.sample(4.0, {at(0, 0), at(20, 0, 0.0, parked)}).people_at({{3, 4}, {0, 4.9}, {20, 1}});  // 3 s: two, and one
  trial.sample(5.0, {at(0, 0), at(20, 0, 0.0, parked)}).people_at({{20, 1}, {20, 2}});  // 1 s: none; robot 1 is parked
  trial.end(5.0, {never, 4.0});

  const Measurement m = measure("dmrp.metric.people_nearby", trial);
  CHECK(m.robot("people_nearby", 0) == Approx(1.4));   // (1 * 1 + 3 * 2 + 1 * 0) / 5
  CHECK(m.robot("people_nearby", 1) == Approx(0.75));  // (1 * 0 + 3 * 1) / 4
  CHECK(m.system("people_nearby") == Approx(1.075));
}

TEST_CASE("success is 0, not undefined, when no robot arrives") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {1, 0}}, {{3, 0}, {4, 0}}});
  trial.sample(0.0, {at(0, 0), at(3, 0)}).end(180.0, {never, never});

  const Measurement m = measure("dmrp.metric.success", trial);
  CHECK(m.system("success") == 0.0);
  CHECK(m.system("trial_success") == 0.0);
  CHECK(m.system("safe_success") == 0.0);
}

TEST_CASE("safe success requires that no contact is the robot's fault") {
  SyntheticTrial trial(6);
  const std::vector<dmrp_robot_sample> robots(6, at(0, 0));
  trial.plan(std::vector<Points>(6, Points{{0, 0}}));
  trial.sample(0.0, robots).people({41, 42, 43});
  trial.sample(1.0, robots)
      .people({41, 42, 43})
      .contacts({
          contact(DMRP_CONTACT_STATIC, 0, 0, begins | fault_a),      // 0: into a shelf
          contact(DMRP_CONTACT_ROBOT, 1, 2, begins | fault_b),       // 2 drove into 1
          contact(DMRP_CONTACT_PERSON, 3, 0, begins | fault_a),      // 3 drove into a person
          contact(DMRP_CONTACT_PERSON, 4, 1, begins | fault_b),      // a person walked into 4
          contact(DMRP_CONTACT_PERSON, 5, 2, begins | fault_a | 8u)  // a bit that is not known: ignored
      });
  trial.end(1.0);

  const Measurement m = measure("dmrp.metric.success", trial);
  CHECK(m.robot("safe_success", 0) == 0.0);
  CHECK(m.robot("safe_success", 1) == 1.0);
  CHECK(m.robot("safe_success", 2) == 0.0);
  CHECK(m.robot("safe_success", 3) == 0.0);
  CHECK(m.robot("safe_success", 4) == 1.0);
  CHECK(m.robot("safe_success", 5) == 0.0);
  CHECK(m.system("safe_success") == Approx(2.0 / 6.0));
  for (std::uint32_t robot = 0; robot < 6; ++robot) CHECK(m.robot("contact_free_success", robot) == 0.0);
  CHECK(m.system("success") == 1.0);
  CHECK(m.system("trial_success") == 1.0);
}

TEST_CASE("safe success is weighted by the least time over the time of arrival") {
  constexpr double v_max = 0.8;
  SyntheticTrial trial(6);
  for (std::size_t robot = 0; robot < 5; ++robot) trial.route(robot, {0, 0, 0}, {{3, 4, std::nan("")}});
  const std::vector<dmrp_robot_sample> robots(6, at(0, 0));
  trial.plan(std::vector<Points>(6, Points{{0, 0}}));
  trial.sample(0.0, robots);
  trial.sample(1.0, robots).contacts({contact(DMRP_CONTACT_STATIC, 3, 0, begins | fault_a)});
  // the shortest way, 5 m, at v_max; in twice that time; faster, by the goal's tolerance; into a wall; failed; at its goal
  const double least_s = 5.0 / v_max;
  trial.end(20.0, {least_s, 2.0 * least_s, 0.9 * least_s, least_s, never, 20.0});

  const Measurement m = measure("dmrp.metric.success", trial);
  CHECK_THAT(m.robot("safe_sct", 0), WithinAbs(1.0, 1e-9));
  CHECK_THAT(m.robot("safe_sct", 1), WithinAbs(0.5, 1e-9));
  CHECK(m.robot("safe_sct", 2) == 1.0);
  CHECK(m.robot("safe_sct", 3) == 0.0);
  CHECK(m.robot("safe_sct", 4) == 0.0);
  CHECK(m.robot("safe_sct", 5) == 1.0);
  CHECK_THAT(m.system("safe_sct"), WithinAbs(3.5 / 6.0, 1e-9));
}

TEST_CASE("safe success weighted by time is in [0, safe_success], whatever the time of arrival") {
  constexpr std::size_t robots = 40;
  SyntheticTrial trial(robots);
  std::vector<double> arrivals;
  for (std::size_t robot = 0; robot < robots; ++robot) {
    trial.route(robot, {0, 0, 0}, {{0.3 * static_cast<double>(robot % 7), 4.0, std::nan("")}});
    arrivals.push_back(robot % 5 == 0 ? never : 0.02 * static_cast<double>(robot * robot));
  }
  trial.plan(std::vector<Points>(robots, Points{{0, 0}}));
  trial.sample(0.0, std::vector<dmrp_robot_sample>(robots, at(0, 0)));
  trial.sample(40.0, std::vector<dmrp_robot_sample>(robots, at(0, 0)))
      .contacts({contact(DMRP_CONTACT_STATIC, 3, 0, begins | fault_a)});
  trial.end(40.0, arrivals);
  const Measurement m = measure("dmrp.metric.success", trial);
  for (std::uint32_t robot = 0; robot < robots; ++robot) {
    CHECK(m.robot("safe_sct", robot) >= 0.0);
    CHECK(m.robot("safe_sct", robot) <= m.robot("safe_success", robot));
    CHECK((m.robot("safe_sct", robot) > 0.0) == (m.robot("safe_success", robot) > 0.0));
  }
  CHECK(m.system("safe_sct") <= m.system("safe_success"));
}

TEST_CASE("path length is the sum of the driven lengths") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {3, 5}}, {{9, 9}}});
  trial.sample(0.0, {at(0, 0), at(9, 9)});
  trial.sample(1.0, {at(3, 4), at(9, 9)});  // 3-4-5: 5 m
  trial.sample(2.0, {at(3, 4), at(9, 9)});  // waits
  trial.sample(3.0, {at(3, 3), at(9, 9)});  // 1 m back: driven, though it leads nowhere
  trial.sample(4.0, {at(3, 5), at(9, 9)});  // 2 m
  trial.end(4.0);

  const Measurement m = measure("dmrp.metric.path_length", trial);
  CHECK(m.robot("path_length", 0) == 8.0);  // 5 + 0 + 1 + 2
  CHECK(m.robot("path_length", 1) == 0.0);  // never moved
  CHECK(m.system("path_length") == 8.0);
}

TEST_CASE("path length stays accurate over many small steps") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {0.1, 0}}});
  for (int i = 0; i <= 9000; ++i) trial.sample(i * 0.02, {at(i % 2 == 0 ? 0.0 : 0.1, 0)});  // to and fro
  trial.end(180.0);
  // 9000 * 0.1; adding 0.1 up plainly ends 1e-10 away
  CHECK_THAT(measure("dmrp.metric.path_length", trial).system("path_length"), WithinAbs(900.0, 1e-12));
}

TEST_CASE("planned length and turns come from the first plan, without waits") {
  SyntheticTrial trial(5);
  trial.plan({
      {{0, 0}, {1, 0}, {2, 0}, {2, 0}, {2, 0}, {2, 1}, {2, 2}, {3, 2}},  // E E wait wait N N E: 5 m, 2 turns
      {{9, 9}},                                                          // stays: 0 m
      {{5, 5}, {6, 6}, {7, 6}},                                          // NE E: sqrt2 + 1, 1 turn
      {{0, 5}, {1, 5}, {1, 5}, {0, 5}},                                  // there, wait, back: 2 m, 1 turn
      {{0, 7}, {0.1, 7.1}, {0.1 + 0.1, 7.2}, {0.1 + 0.1 + 0.1, 7.3}}     // straight but for rounding: 0 turns
  });
  trial.sample(0.0, {at(0, 0), at(9, 9), at(5, 5), at(0, 5), at(0, 7)});
  trial.plan(std::vector<Points>(5, Points{{0, 0}, {50, 0}, {50, 50}}));  // a replan changes nothing
  trial.sample(1.0, {at(0, 0), at(9, 9), at(5, 5), at(0, 5), at(0, 7)}).end(1.0);

  const Measurement m = measure("dmrp.metric.path_length", trial);
  CHECK(m.robot("planned_length", 0) == 5.0);
  CHECK(m.robot("planned_length", 1) == 0.0);
  CHECK_THAT(m.robot("planned_length", 2), WithinAbs(2.414213562373095, 1e-12));
  CHECK(m.robot("planned_length", 3) == 2.0);
  CHECK_THAT(m.robot("planned_length", 4), WithinAbs(0.4242640687119285, 1e-12));  // 0.3 sqrt2
  CHECK_THAT(m.system("planned_length"), WithinAbs(9.838477631085024, 1e-12));     // 5 + 0 + 2.41421 + 2 + 0.42426
  CHECK(m.robot("plan_turns", 0) == 2.0);
  CHECK(m.robot("plan_turns", 1) == 0.0);
  CHECK(m.robot("plan_turns", 2) == 1.0);
  CHECK(m.robot("plan_turns", 3) == 1.0);
  CHECK(m.robot("plan_turns", 4) == 0.0);
  CHECK(m.system("plan_turns") == 4.0);
}

TEST_CASE("planning time is the processor time of the first plan, in milliseconds") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {1, 0}}}, 40'000'000, 12'500'000);
  trial.sample(0.0, {at(0, 0)});
  trial.plan({{{0, 0}, {1, 0}}}, 99'000'000, 98'000'000);
  trial.sample(1.0, {at(1, 0)}).end(1.0);
  CHECK(measure("dmrp.metric.planning_time", trial).system("planning_time") == 12.5);
}

TEST_CASE("planning time is undefined where the processor time was not measured") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {1, 0}}}, 40'000'000).sample(0.0, {at(0, 0)}).end(1.0);
  CHECK(std::isnan(measure("dmrp.metric.planning_time", trial).system("planning_time")));
}

TEST_CASE("completion time is the last arrival") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{3, 0}}}).sample(0.0, {at(0, 0), at(3, 0)});
  trial.end(45.3, {45.3, 20.02});

  const Measurement m = measure("dmrp.metric.completion_time", trial);
  CHECK(m.robot("completion_time", 0) == 45.3);
  CHECK(m.robot("completion_time", 1) == 20.02);
  CHECK(m.system("completion_time") == 45.3);
  CHECK(m.system("mission_time") == 45.3);
}

TEST_CASE("completion time is undefined unless all arrive, mission time never is") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{3, 0}}}).sample(0.0, {at(0, 0), at(3, 0)});
  SECTION("one arrives") {
    trial.end(180.0, {30.0, never});
    const Measurement m = measure("dmrp.metric.completion_time", trial);
    CHECK(m.robot("completion_time", 0) == 30.0);
    CHECK(std::isnan(m.robot("completion_time", 1)));
    CHECK(std::isnan(m.system("completion_time")));
    CHECK(m.system("mission_time") == 180.0);
  }
  SECTION("nobody arrives") {
    trial.end(62.5, {never, never});
    const Measurement m = measure("dmrp.metric.completion_time", trial);
    CHECK(std::isnan(m.robot("completion_time", 0)));
    CHECK(std::isnan(m.system("completion_time")));
    CHECK(m.system("mission_time") == 62.5);
  }
}

TEST_CASE("speed is weighted by time and ends with the arrival") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {2, 0}}, {{5, 5}}});
  trial.sample(0.0, {at(0, 0, 0.7), at(5, 5)});             // stands for no time: its 0.7 m/s does not count
  trial.sample(1.0, {at(1, 0, 1.0), at(5, 5)});             // 1 s at 1 m/s
  trial.sample(4.0, {at(1.6, 0, -0.2, parked), at(5, 5)});  // 3 s backwards at 0.2 m/s; arrives at the end of it
  trial.sample(14.0, {at(1.6, 0, 0.0, parked), at(5, 5)});  // parked: does not count
  trial.end(14.0, {4.0, never});

  const Measurement m = measure("dmrp.metric.speed", trial);
  CHECK_THAT(m.robot("mean_speed", 0), WithinAbs(0.4, 1e-15));  // (1 * 1.0 + 3 * 0.2) / 4
  // (1 * 0.6^2 + 3 * 0.2^2) / 4 = 0.12
  CHECK_THAT(m.robot("speed_sd", 0), WithinAbs(0.34641016151377546, 1e-15));
  CHECK(m.robot("mean_speed", 1) == 0.0);  // never moved
  CHECK(m.robot("speed_sd", 1) == 0.0);
  CHECK_THAT(m.system("mean_speed"), WithinAbs(0.2, 1e-15));  // (0.4 + 0) / 2
  CHECK_THAT(m.system("speed_sd"), WithinAbs(0.17320508075688773, 1e-15));
}

TEST_CASE("speed is measured, not commanded, and includes sideways motion") {
  SyntheticTrial trial(1);
  dmrp_robot_sample robot = at(0, 0, 0.3);
  robot.velocity.v_y = -0.4;
  robot.command.v_x = 0.8;
  trial.plan({{{0, 0}}}).sample(0.0, {robot}).sample(1.0, {robot}).sample(1.5, {robot}).end(1.5);

  const Measurement m = measure("dmrp.metric.speed", trial);
  CHECK_THAT(m.system("mean_speed"), WithinAbs(0.5, 1e-15));  // 3-4-5
  CHECK(m.system("speed_sd") == 0.0);
}

}  // namespace outcome_test
