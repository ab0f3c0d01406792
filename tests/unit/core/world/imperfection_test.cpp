// SPDX-License-Identifier: MIT
// What keeps robots from doing at once what they are told, and from knowing where they are.
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/angle.hpp>
#include <numbers>

#include "core/sensors/odometry.hpp"
#include "core/world/contact_events.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t tick_ns = 100'000'000;

OdometrySettings noise(double a1, double a2, double a3, double a4, std::int64_t fix_period_ns = 0) {
  return {{a1, a2, a3, a4}, fix_period_ns};
}

// What is believed at the end of one motion, over many seeds: mean and standard deviation of its error.
template <class ErrorOf>
std::pair<double, double> error_of(const OdometrySettings& settings, const dmrp_pose& from, const dmrp_pose& to,
                                   ErrorOf error) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 4000;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    Odometry odometry(settings, seed, 2, from);
    odometry.read(0, from, {});
    odometry.read(tick_ns, to, {});
    const double e = error(odometry.pose());
    sum += e;
    squares += e * e;
  }
  return {sum / count, std::sqrt(squares / count)};
}

}  // namespace

TEST_CASE("a command takes effect when its latencies are over, one after the other") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 60'000'000;
  SimulationSettings simulation;
  simulation.control_latency_ns = 100'000'000;  // 0.16 s in all: 8 steps
  World world(scenario, settings, simulation, geometry_of(scenario), 1);
  CHECK(world.set_command(0, {0.5, 0.0, 0.0}).v_x == 0.0);
  std::vector<double> speeds;
  for (int step = 0; step < 30; ++step) {
    if (step == 5) world.set_command(0, {0.0, 0.0, 0.0});  // in force from step 13 on
    world.step({});
    speeds.push_back(world.robots()[0].velocity.v_x);
  }
  for (int step = 0; step < 8; ++step) CHECK(speeds[step] == 0.0);
  for (int step = 8; step < 13; ++step) CHECK(speeds[step] == Approx(0.02 * (step - 7)));  // 1 m/s^2
  for (int step = 13; step < 18; ++step) CHECK(speeds[step] == Approx(0.02 * (17 - step)).margin(1e-12));
  CHECK(speeds[29] == 0.0);
}

TEST_CASE("a latency of parts of a step lasts until the next one, and none is no latency") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 30'000'000;
  World late(scenario, settings, SimulationSettings{}, geometry_of(scenario), 1);
  World prompt(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1);
  late.set_command(0, {0.5, 0.0, 0.0});
  CHECK(prompt.set_command(0, {0.5, 0.0, 0.0}).v_x == 0.5);
  for (World* world : {&late, &prompt})
    for (int step = 0; step < 3; ++step) world->step({});
  CHECK(late.robots()[0].velocity.v_x == Approx(0.02));
  CHECK(prompt.robots()[0].velocity.v_x == Approx(0.06));
}

TEST_CASE("a robot that is given up forgets the commands that are on their way") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.robots = {robot({2, 3, 0}, dmrp_vec2{18, 3})};
  RobotSettings settings;
  settings.actuation_latency_ns = 100'000'000;
  World world(scenario, settings, SimulationSettings{}, geometry_of(scenario), 1);
  world.set_command(0, {0.5, 0.0, 0.0});
  world.fail(0);
  for (int step = 0; step < 50; ++step) world.step({});
  CHECK(world.robots()[0].pose.x == 2.0);
}

TEST_CASE("a braking time has the latency in it") {
  // The robot drives at 0.8 m/s: it needs 0.8 s to stand. The person walks past until 1 s before the contact, and into
  // its way from then on.
  const auto flags = [](std::int64_t latency_ns) {
    ContactTracker tracker(1.0, 0.8, latency_ns);
    dmrp_contact contact{};
    contact.kind = DMRP_CONTACT_PERSON;
    dmrp_agent robot{};
    robot.radius_m = 0.25;
    dmrp_agent person{};
    person.radius_m = 0.3;
    for (int step = 100; step >= 0; --step) {
      const double left_s = 0.02 * step;
      robot.pose = {-0.8 * left_s, 0.0, 0.0};
      robot.velocity = {0.8, 0.0};
      person.pose = {0.55, left_s, 0.0};  // from the side, at 1 m/s
      person.velocity = left_s > 1.0 ? dmrp_vec2{0.0, 3.0} : dmrp_vec2{0.0, -1.0};
      tracker.update(2 * second_ns - std::llround(left_s * 1e9), {&robot, 1}, {&person, 1},
                     {&contact, step == 0 ? std::size_t{1} : std::size_t{0}});
    }
    return contact.flags;
  };
  CHECK((flags(0) & DMRP_CONTACT_UNAVOIDABLE) == 0);
  CHECK((flags(400'000'000) & DMRP_CONTACT_UNAVOIDABLE) != 0);
}

TEST_CASE("without noise a robot knows where it is, to the bit") {
  Odometry odometry({}, 1, 0, {1, 2, 0.3});
  odometry.read(0, {1, 2, 0.3}, {});
  const dmrp_pose there = {1.1, 2.05, 0.31};
  odometry.read(tick_ns, there, {0.5, 0.0, 0.1});
  CHECK(odometry.pose().x == there.x);
  CHECK(odometry.pose().theta == there.theta);
  CHECK(odometry.velocity().omega == 0.1);
  const dmrp_pose seen = odometry.to_estimated({5, 5, 1.0});
  CHECK(seen.x == 5.0);
  CHECK(seen.theta == 1.0);
}

TEST_CASE("errors of odometry have the variances of the model") {
  // straight on by 0.5 m: the way errs by a3 d^2; the turn before by a2 d^2, which leads aside
  const dmrp_pose origin = {0, 0, 0};
  const dmrp_pose ahead = {0.5, 0, 0};
  auto [mean, sd] = error_of(noise(0, 0, 0.04, 0), origin, ahead, [](const dmrp_pose& p) { return p.x - 0.5; });
  CHECK(mean == Approx(0.0).margin(0.006));
  CHECK(sd == Approx(0.2 * 0.5).epsilon(0.05));
  std::tie(mean, sd) = error_of(noise(0, 0.01, 0, 0), origin, ahead, [](const dmrp_pose& p) { return p.y; });
  CHECK(mean == Approx(0.0).margin(0.002));
  CHECK(sd == Approx(0.5 * 0.1 * 0.5).epsilon(0.05));
  // both turns err by it
  std::tie(mean, sd) = error_of(noise(0, 0.01, 0, 0), origin, ahead, [](const dmrp_pose& p) { return p.theta; });
  CHECK(sd == Approx(std::sqrt(2.0) * 0.1 * 0.5).epsilon(0.05));
  // a turn on the spot errs by a1 turn^2, and makes it seem to have moved by a4 turn^2
  const dmrp_pose turned = {0, 0, 0.4};
  std::tie(mean, sd) = error_of(noise(0.09, 0, 0, 0), origin, turned, [](const dmrp_pose& p) { return p.theta - 0.4; });
  CHECK(sd == Approx(0.3 * 0.4).epsilon(0.05));
  std::tie(mean, sd) =
      error_of(noise(0, 0, 0, 0.25), origin, turned, [](const dmrp_pose& p) { return std::hypot(p.x, p.y); });
  CHECK(sd == Approx(0.5 * 0.4).epsilon(0.05));
  // backward is as good as forward
  std::tie(mean, sd) =
      error_of(noise(0.09, 0, 0.04, 0), origin, {-0.5, 0, 0}, [](const dmrp_pose& p) { return p.x + 0.5; });
  CHECK(sd == Approx(0.2 * 0.5).epsilon(0.05));
  // who stands does not drift
  std::tie(mean, sd) = error_of(noise(1, 1, 1, 1), origin, origin, [](const dmrp_pose& p) { return p.x + p.theta; });
  CHECK(sd == 0.0);
}

TEST_CASE("drift grows until a fix, and the speed told is that of the reading") {
  Odometry odometry(noise(0.01, 0.01, 0.01, 0.01, second_ns), 3, 0, {0, 0, 0});
  double largest_m = 0.0;
  dmrp_pose before_believed{};
  for (int tick = 0; tick <= 100; ++tick) {
    const dmrp_pose truth = {0.05 * tick, 0.0, 0.0};
    odometry.read(tick * tick_ns, truth, {0.5, 0.0, 0.0});
    const double error_m = std::hypot(odometry.pose().x - truth.x, odometry.pose().y - truth.y);
    if (tick > 0 && tick % 10 == 0) {
      CHECK(error_m == 0.0);
    } else if (tick > 1) {
      const double went_m = std::hypot(odometry.pose().x - before_believed.x, odometry.pose().y - before_believed.y);
      CHECK(odometry.velocity().v_x == Approx(went_m / 0.1));
    }
    largest_m = std::max(largest_m, error_m);
    before_believed = odometry.pose();
  }
  CHECK(largest_m > 0.005);
}

TEST_CASE("what a robot sees lies about where it believes to be") {
  Odometry odometry(noise(0.5, 0.5, 0.5, 0.5), 5, 0, {0, 0, 0});
  odometry.read(0, {0, 0, 0}, {});
  odometry.read(tick_ns, {0.3, 0.1, 0.4}, {});
  const dmrp_pose believed = odometry.pose();
  REQUIRE(std::abs(believed.theta - 0.4) > 1e-3);
  // 2 m straight ahead, facing the robot
  const dmrp_pose other = {0.3 + 2.0 * std::cos(0.4), 0.1 + 2.0 * std::sin(0.4), 0.4 + pi};
  const dmrp_pose seen = odometry.to_estimated(other);
  CHECK(seen.x == Approx(believed.x + 2.0 * std::cos(believed.theta)));
  CHECK(seen.y == Approx(believed.y + 2.0 * std::sin(believed.theta)));
  CHECK(std::abs(toolkit::difference(seen.theta, believed.theta + pi)) < 1e-12);
  const dmrp_vec2 toward = odometry.direction_to_estimated({std::cos(0.4), std::sin(0.4)});
  CHECK(toward.x == Approx(std::cos(believed.theta)));
}

TEST_CASE("noise is a matter of the seed, the robot and the time") {
  const auto after = [](std::uint64_t seed, std::uint32_t robot) {
    Odometry odometry(noise(0.1, 0.1, 0.1, 0.1), seed, robot, {0, 0, 0});
    odometry.read(0, {0, 0, 0}, {});
    odometry.read(tick_ns, {0.08, 0, 0.05}, {});
    return odometry.pose().x;
  };
  CHECK(after(1, 0) == after(1, 0));
  CHECK(after(1, 0) != after(2, 0));
  CHECK(after(1, 0) != after(1, 1));
}
