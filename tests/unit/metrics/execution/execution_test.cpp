// SPDX-License-Identifier: MIT
// Smoothness, idle time and compute time: cases computed by hand.
#include <dmrp/robot_event.h>
#include <dmrp/status.h>

#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace execution_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

dmrp_call call(std::uint32_t kind, std::uint32_t robot, double milliseconds, std::int32_t status = DMRP_OK) {
  return {kind, robot, status, 0, std::llround(milliseconds * 1e6)};
}

TEST_CASE("path irregularity is the turning beyond the least that the goals need, per metre") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}});
  // east to (4, 0), then north to (4, 3), there to face west; begins facing north: least 90 + 90 + 90 degrees
  trial.route(0, {0, 0, 0.5 * M_PI}, {{4, 0, 1.0}, {4, 3, M_PI}});
  trial.sample(0.0, {facing(0, 0, 0.5 * M_PI)});
  trial.sample(1.0, {facing(0, 0, -0.1)});          // pi/2 + 0.1
  trial.sample(2.0, {facing(2, 0, 0.1)});           // 0.2
  trial.sample(3.0, {facing(4, 0, 0.0)});           // 0.1
  trial.sample(4.0, {facing(4, 0, 0.5 * M_PI)});    // pi/2
  trial.sample(5.0, {facing(4, 3, 0.5 * M_PI)});    // 0
  trial.sample(6.0, {facing(4, 3, M_PI, parked)});  // pi/2, the step of the arrival
  trial.sample(7.0, {facing(4, 3, -1.0, parked)});  // parked: not counted
  trial.end(7.0, {6.0});
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK_THAT(m.system("heading_change"), WithinAbs(1.5 * M_PI + 0.4, 1e-14));
  CHECK_THAT(m.system("path_irregularity"), WithinAbs(0.4 / 7.0, 1e-14));
}

TEST_CASE("path irregularity is 0 for a robot that turned less than needed, undefined for one that stood") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  trial.route(0, {0, 0, 0}, {{-9, 0, std::nan("")}}).route(1, {0, 0, 0}, {{-9, 0, std::nan("")}});
  trial.sample(0.0, {facing(0, 0, 0), facing(0, 0, 0)}).sample(1.0, {facing(1, 0, 0.5), facing(0, 0, 0.5)}).end(1.0);
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK(m.robot("path_irregularity", 0) == 0.0);
  CHECK(std::isnan(m.robot("path_irregularity", 1)));
  CHECK(m.system("path_irregularity") == 0.0);
}

TEST_CASE("acceleration and jerk are time averages of the differences from step to step") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  const double speeds[] = {0.0, 0.5, 1.0, 1.0, 0.0, 0.0};  // a: 0.5, 0.5, 0, -1, 0; da: 0, 0.5, 1, 1
  for (int t = 0; t <= 5; ++t)
    trial.sample(t, {at(0, 0, speeds[t]), at(0, 0, speeds[t], t >= 3 ? parked : DMRP_ROBOT_ACTIVE)});
  trial.end(5.0, {never, 3.0});
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK_THAT(m.robot("acceleration", 0), WithinAbs(2.0 / 5.0, 1e-15));
  CHECK_THAT(m.robot("jerk", 0), WithinAbs(2.5 / 4.0, 1e-15));
  CHECK_THAT(m.robot("acceleration", 1), WithinAbs(1.0 / 3.0, 1e-15));  // until it arrives at 3 s
  CHECK_THAT(m.robot("jerk", 1), WithinAbs(0.5 / 2.0, 1e-15));
}

TEST_CASE("acceleration and jerk weight steps by their length") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}});
  trial.sample(0.0, {at(0, 0, 0.0)}).sample(0.5, {at(0, 0, 0.5)}).sample(2.0, {at(0, 0, -1.0)}).end(2.0, {never});
  // a: 1 for 0.5 s, -1 for 1.5 s; da: 2 from the middle of one to the middle of the other, 1 s
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK_THAT(m.system("acceleration"), WithinAbs(1.0, 1e-15));
  CHECK_THAT(m.system("jerk"), WithinAbs(2.0, 1e-15));
}

TEST_CASE("acceleration does not depend on the sampling period") {
  for (const int steps : {10, 1000}) {
    SyntheticTrial trial(1);
    trial.plan({{{0, 0}}});
    for (int i = 0; i <= steps; ++i)  // up to 1 m/s and down again in 10 s
      trial.sample(10.0 * i / steps, {at(0, 0, 1.0 - std::fabs(1.0 - 2.0 * i / steps))});
    trial.end(10.0, {never});
    CHECK_THAT(measure("dmrp.metric.smoothness", trial).system("acceleration"), WithinAbs(0.2, 1e-12));
  }
}

TEST_CASE("idle time is the active time in which a robot neither drives nor turns") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  const auto moving = [](double speed, double omega, std::uint32_t state = DMRP_ROBOT_ACTIVE) {
    dmrp_robot_sample robot = at(0, 0, speed, state);
    robot.velocity.omega = omega;
    return robot;
  };
  trial.sample(1.0, {moving(0.009, 0.019)});       // idle
  trial.sample(3.0, {moving(-0.009, -0.019)});     // idle
  trial.sample(7.0, {moving(0.01, 0.0)});          // drives
  trial.sample(8.0, {moving(-0.3, 0.0)});          // backs
  trial.sample(9.0, {moving(0.0, 0.02)});          // turns
  trial.sample(9.5, {moving(0.0, 0.0, parked)});   // idle in the step of its arrival
  trial.sample(99.0, {moving(0.0, 0.0, parked)});  // parked
  trial.end(99.0, {9.5});
  CHECK(measure("dmrp.metric.idle_time", trial).system("idle_time") == 3.5);
}

TEST_CASE("PFD has a maximum and a standard deviation") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}, {9, 0}}, {{0, 0}, {9, 0}}}).sample(0.0, {at(0, 5), at(0, 5)});
  trial.sample(1.0, {at(1, 0.1), at(1, 0.5)}).sample(2.0, {at(2, 0.3), at(2, -0.5)});
  trial.sample(3.0, {at(3, -0.2), at(3, 0.5)}).sample(4.0, {at(4, 9), at(4, 9)}).without_control();
  trial.end(4.0, {never, never});
  const Measurement m = measure("dmrp.metric.pfd", trial);
  CHECK(m.robot("pfd_max", 0) == 0.3);
  CHECK(m.system("pfd_max") == 0.5);
  CHECK_THAT(m.robot("pfd_sd", 0), WithinAbs(std::sqrt(0.02 / 3), 1e-15));  // 0.1 0.3 0.2 about 0.2
  CHECK_THAT(m.robot("pfd_sd", 1), WithinAbs(0.0, 1e-15));
  CHECK_THAT(m.system("pfd_sd"), WithinAbs(std::sqrt(0.02 / 3) / 2, 1e-15));
}

TEST_CASE("compute time comes from the recorded calls") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(0, 0)}).calls({call(DMRP_CALL_PLAN, 0, 12.0)});
  // robot 0: 1 ms, 2 ms, ..., 200 ms, of which 100 are longer than the period of 100 ms; robot 1 twice 1 ms
  for (int i = 1; i <= 200; ++i) {
    std::vector<dmrp_call> calls = {call(DMRP_CALL_CONTROL, 0, 201 - i), call(DMRP_CALL_PEOPLE, 0, 500)};
    if (i <= 2) calls.push_back(call(DMRP_CALL_CONTROL, 1, 1.0));
    if (i == 50) calls.push_back(call(DMRP_CALL_PLAN, 0, 60.0, DMRP_TIMEOUT));
    trial.sample(i, {at(0, 0), at(0, 0)}).calls(calls);
  }
  trial.end(200.0, {never, never});
  const Measurement m = measure("dmrp.metric.compute_time", trial);
  CHECK(m.system("plan_call_mean") == 36.0);
  CHECK(m.system("plan_call_p99") == 60.0);
  CHECK(m.system("plan_missed") == 50.0);
  CHECK(m.robot("control_call_mean", 0) == 100.5);
  CHECK(m.robot("control_call_p99", 0) == 198.0);  // the 198th of 200
  CHECK(m.robot("control_missed", 0) == 50.0);
  CHECK(m.robot("control_call_mean", 1) == 1.0);
  CHECK(m.robot("control_call_p99", 1) == 1.0);
  CHECK(m.robot("control_missed", 1) == 0.0);
  CHECK_THAT(m.system("control_call_mean"), WithinAbs(20102.0 / 202.0, 1e-12));
  CHECK(m.system("control_call_p99") == 198.0);  // the 200th of 202
  CHECK_THAT(m.system("control_missed"), WithinAbs(100.0 * 100 / 202, 1e-12));
}

TEST_CASE("calls of a controller of all robots count for the system alone") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  trial.sample(0.0, {at(0, 0), at(0, 0)}).calls({call(DMRP_CALL_CONTROL, DMRP_ALL_ROBOTS, 4.0)});
  trial.end(1.0, {never, never});
  const Measurement m = measure("dmrp.metric.compute_time", trial);
  CHECK(m.system("control_call_mean") == 4.0);
  CHECK(std::isnan(m.robot("control_call_mean", 0)));
}

TEST_CASE("clipped commands are counted by robot") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  for (int i = 0; i < 10; ++i) {
    std::vector<dmrp_robot_event> events = {becomes(0, DMRP_CLASS_STUCK), {99, 1, 0, 0, DMRP_NOBODY}};
    if (i % 3 == 0) events.push_back({DMRP_ROBOT_EVENT_CLIPPED, 1, 0, 0, DMRP_NOBODY});
    trial.sample(i, {at(0, 0), at(0, 0)}).events(events);
  }
  trial.end(10.0, {never, never});
  const Measurement m = measure("dmrp.metric.clipped_commands", trial);
  CHECK(m.robot("clipped_commands", 0) == 0.0);
  CHECK(m.robot("clipped_commands", 1) == 4.0);
  CHECK(m.system("clipped_commands") == 4.0);
}

TEST_CASE("recoveries are counted by robot, and each is an event with its steps") {
  const auto recovery = [](std::uint32_t robot, std::uint32_t step) {
    return dmrp_robot_event{DMRP_ROBOT_EVENT_RECOVERY, robot, 0, step, DMRP_NOBODY};
  };
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  for (int i = 0; i <= 20; ++i) {
    std::vector<dmrp_robot_event> events = {becomes(0, DMRP_CLASS_SETTLING)};
    if (i == 4) events.push_back(recovery(1, DMRP_RECOVERY_SPIN));
    if (i == 6) events.push_back(recovery(1, DMRP_RECOVERY_WAIT));
    if (i == 9) events.push_back(recovery(1, DMRP_RECOVERY_NONE));
    if (i == 19) events.push_back(recovery(1, 77));  // of a later host
    trial.sample(i, {at(0, 0), at(2, 1)}).events(events);
  }
  trial.end(20.0, {never, never});
  const Measurement m = measure("dmrp.metric.recoveries", trial);
  CHECK(m.robot("recoveries", 0) == 0.0);
  CHECK(m.robot("recoveries", 1) == 2.0);
  CHECK(m.system("recoveries") == 2.0);
  REQUIRE(m.events.size() == 2);
  CHECK(m.events[0].from_s == 3.0);
  CHECK(m.events[0].to_s == 8.0);
  CHECK(m.events[0].text == "robot 1 recovers: spin, wait");
  CHECK(m.events[1].to_s == 20.0);
  CHECK(m.events[1].text == "robot 1 recovers: step 77");
}

TEST_CASE("interventions are runs of reduced commands, and each is an event") {
  const auto reduced = [](std::uint32_t robot, std::int64_t tick, std::uint32_t percent) {
    return dmrp_robot_event{DMRP_ROBOT_EVENT_MONITOR, robot, (tick - 1) * 1'000'000'000, percent, DMRP_NOBODY};
  };
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  for (int i = 0; i <= 20; ++i) {  // a control tick a second
    std::vector<dmrp_robot_event> events = {becomes(0, DMRP_CLASS_SETTLING)};
    if (i == 4) events.push_back(reduced(1, i, 50));
    if (i == 5) events.push_back(reduced(1, i, 0));
    if (i == 6) events.push_back(reduced(1, i, 75));
    if (i == 9) events.push_back(reduced(1, i, 25));
    if (i == 20) events.push_back(reduced(1, i, 75));
    trial.sample(i, {at(0, 0), at(2, 1)}).events(events);
  }
  trial.end(20.0, {never, never});
  const Measurement m = measure("dmrp.metric.interventions", trial);
  CHECK(m.robot("interventions", 0) == 0.0);
  CHECK(m.robot("interventions", 1) == 3.0);
  CHECK(m.system("interventions") == 3.0);
  CHECK(m.robot("intervention_time", 0) == 0.0);
  CHECK(m.robot("intervention_time", 1) == 5.0);
  CHECK(m.system("intervention_time") == 5.0);
  REQUIRE(m.events.size() == 3);
  CHECK(m.events[0].from_s == 3.0);
  CHECK(m.events[0].to_s == 6.0);
  CHECK(m.events[0].text == "the collision monitor leaves robot 1 0 % of its command");
  CHECK(m.events[1].from_s == 8.0);
  CHECK(m.events[1].to_s == 9.0);
  CHECK(m.events[2].to_s == 20.0);
}

TEST_CASE("an intervention lasts until the next control tick") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}});
  trial.sample(0.0, {at(0, 0)});
  for (int i = 1; i <= 8; ++i) {  // a control tick every four samples
    trial.sample(i, {at(0, 0)});
    if (i == 1) trial.events({{DMRP_ROBOT_EVENT_MONITOR, 0, 0, 25, DMRP_NOBODY}});
    if (i % 4 != 0) trial.without_control();
  }
  trial.end(8.0, {never});
  const Measurement m = measure("dmrp.metric.interventions", trial);
  CHECK(m.system("interventions") == 1.0);
  CHECK(m.system("intervention_time") == 4.0);
}

}  // namespace execution_test
