// SPDX-License-Identifier: MIT
// One test for each bug that was found in the metric code of other benchmarks.
#include <catch2/catch.hpp>

#include "tests/unit/metrics/synthetic_trial.hpp"

namespace known_bugs_test {

using namespace dmrp::test;
using Catch::Matchers::WithinAbs;

TEST_CASE("known bug: jerk as dv/dt^2 (HuNavSim)") {
  // under a constant acceleration of 0.5 m/s^2 there is no jerk; dv/dt^2 would be 0.25 / 0.5^2 = 1
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}});
  for (int i = 0; i <= 10; ++i) trial.sample(0.5 * i, {at(0, 0, 0.25 * i)});
  trial.end(5.0, {never});
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK_THAT(m.system("acceleration"), WithinAbs(0.5, 1e-15));
  CHECK_THAT(m.system("jerk"), WithinAbs(0.0, 1e-15));
}

TEST_CASE("known bug: abs(w < 0.02) (HuNavSim)") {
  // turning to the right at 1 rad/s is not standing still
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)});
  dmrp_robot_sample turning = at(0, 0);
  turning.velocity.omega = -1.0;
  trial.sample(5.0, {turning}).end(5.0, {never});
  CHECK(measure("dmrp.metric.idle_time", trial).system("idle_time") == 0.0);
}

TEST_CASE("known bug: collisions counted per step (HuNavSim)") {
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).people({5});
  for (int i = 1; i <= 50; ++i) {
    const std::uint32_t flags = DMRP_CONTACT_FAULT_A | (i == 1 ? DMRP_CONTACT_BEGINS : 0U);
    trial.sample(0.02 * i, {at(0, 0)}).people({5}).contacts({contact(DMRP_CONTACT_PERSON, 0, 0, flags)});
  }
  trial.end(1.0, {never});
  const Measurement m = measure("dmrp.metric.collisions", trial);
  CHECK(m.system("collisions") == 1.0);
  CHECK(m.system("collisions_at_fault") == 1.0);
  CHECK(m.system("collisions_person") == 1.0);
}

TEST_CASE("known bug: heading taken from position (SocNavBench)") {
  SyntheticTrial trial(2);
  trial.plan({{{0, 0}}, {{0, 0}}});
  // robot 0 turns on the spot by 3 rad; robot 1 backs and drives on again without turning at all
  trial.sample(0.0, {facing(0, 0, 0.0), facing(0, 0, 0.0)});
  trial.sample(1.0, {facing(0, 0, 1.5), facing(-1, 0, 0.0)});
  trial.sample(2.0, {facing(0, 0, 3.0), facing(1, 0, 0.0)});
  trial.end(2.0, {never, never});
  const Measurement m = measure("dmrp.metric.smoothness", trial);
  CHECK(m.robot("heading_change", 0) == 3.0);
  CHECK(m.robot("heading_change", 1) == 0.0);
}

TEST_CASE("known bug: TTC without the person's radius (SocNavBench)") {
  SyntheticTrial trial(1);
  dmrp_person ahead{};
  ahead.position = {2.0, 0.0};
  ahead.radius_m = 0.3;
  trial.plan({{{0, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(0, 0, 0.5)}).crowd({ahead}).end(1.0, {never});
  // 2 m less 0.25 m less 0.3 m at 0.5 m/s
  CHECK_THAT(measure("dmrp.metric.time_to_collision", trial).system("ttc_min"), WithinAbs(2.9, 1e-14));
}

TEST_CASE("known bug: success without checking the goal (Arena)") {
  // the trial ends before its limit, without a contact: the robot is not at its goal all the same
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}, {9, 0}}}).sample(0.0, {at(0, 0)}).sample(1.0, {at(1, 0)}).end(1.0, {never});
  CHECK(measure("dmrp.metric.success", trial).system("success") == 0.0);
  CHECK(measure("dmrp.metric.success", trial).system("safe_success") == 0.0);
  CHECK(measure("dmrp.metric.arrivals", trial).system("isr") == 0.0);
  CHECK(measure("dmrp.metric.spl", trial).system("spl") == 0.0);
}

TEST_CASE("known bug: yaw not wrapped (Arena)") {
  // from 3.1 to -3.1 rad is 0.083 rad to the left, not 6.2 rad to the right
  SyntheticTrial trial(1);
  trial.plan({{{0, 0}}}).sample(0.0, {facing(0, 0, 3.1)}).sample(1.0, {facing(0, 0, -3.1)}).end(1.0, {never});
  CHECK_THAT(measure("dmrp.metric.smoothness", trial).system("heading_change"), WithinAbs(2 * M_PI - 6.2, 1e-14));
}

TEST_CASE("known bug: danger intervals of one sample and the last interval dropped (MRPB)") {
  SyntheticTrial trial(1);
  trial.box("wall", {1, -9}, {2, 9}).plan({{{0, 0}}});
  const double x[] = {0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.6};  // 0.6 is 0.15 m from the wall
  for (int t = 0; t < 10; ++t) trial.sample(t, {at(x[t], 0)});
  trial.end(9.0, {never});
  // (1, 2] and (7, 9], open at the end
  CHECK_THAT(measure("dmrp.metric.clearance", trial).system("danger_time"), WithinAbs(100.0 * 3 / 9, 1e-13));
}

}  // namespace known_bugs_test
