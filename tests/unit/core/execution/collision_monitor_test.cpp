// SPDX-License-Identifier: MIT
#include "core/execution/collision_monitor.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "core/execution/sensed_bodies.hpp"
#include "core/scene/footprint.hpp"
#include "tests/support/draws.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace collision_monitor_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;
using dmrp::test::draws;
using toolkit::Stream;

constexpr std::int64_t minute_ns = 60'000'000'000;

RobotSettings disc(Drive drive) {
  RobotSettings type;
  type.drive = drive;
  type.v_min = -0.4;
  if (drive == Drive::holonomic) type.v_y_max = 0.6;
  if (drive == Drive::ackermann) type.wheelbase_m = 0.5;
  return type;
}

// Longer than wide, and its origin is not its middle.
RobotSettings cart(Drive drive) {
  RobotSettings type = disc(drive);
  type.parts = {{{-0.2, -0.25}, {0.5, -0.25}, {0.5, 0.25}, {-0.2, 0.25}}};
  type.radius_m = circumscribed_radius(type.parts);
  return type;
}

Track walk(dmrp_vec2 from, dmrp_vec2 velocity) {
  return {{{0, from}, {minute_ns, from + 60.0 * velocity}}};
}

// Drives at random: a command for 0.1 to 2 s, often beyond what the robot can.
class RandomDriver {
 public:
  explicit RandomDriver(Stream& stream) : stream_(stream) {}

  dmrp_twist command() {
    if (ticks_-- == 0) {
      ticks_ = static_cast<int>(stream_.below(20));
      command_ = {stream_.uniform(-0.5, 1.0), stream_.uniform(-0.7, 0.7), stream_.uniform(-1.2, 1.2)};
    }
    return command_;
  }

 private:
  Stream& stream_;
  int ticks_ = 0;
  dmrp_twist command_{};
};

bool is_of_robot_0(const dmrp_contact& contact) {
  return contact.a == 0 || (contact.kind == DMRP_CONTACT_ROBOT && contact.b == 0);
}

void tick(World& world, const dmrp_twist& command) {
  world.set_command(0, monitored(world, 0, command).command);
}

bool is_control_tick(const World& world) {
  return world.t_ns() % world.settings().control_period_ns == 0;
}

std::span<const dmrp_contact> step(World& world) {
  return world.step(std::vector<dmrp_vec2>(world.people().size()));
}

double gap_to_person(const World& world, std::size_t person) {
  const dmrp_agent& agent = world.person_agents()[person];
  return gap_between(body_of(world.robot_settings(0), world.robots()[0].pose),
                     {toolkit::position(agent.pose), agent.radius_m, {}});
}

SimulationSettings with_latency(RobotSettings& type, bool is_late) {
  SimulationSettings settings;
  settings.control_latency_ns = is_late ? 100'000'000 : 0;
  type.actuation_latency_ns = is_late ? 50'000'000 : 0;
  return settings;
}

// How far the robot comes in 20 s, without a contact.
double driven_m(World& world, const dmrp_twist& command) {
  const dmrp_vec2 from = toolkit::position(world.robots()[0].pose);
  while (world.t_ns() < minute_ns / 3) {
    if (is_control_tick(world)) tick(world, command);
    for (const dmrp_contact& contact : step(world)) CHECK_FALSE(is_of_robot_0(contact));
  }
  return toolkit::distance(from, toolkit::position(world.robots()[0].pose));
}

const std::vector<RobotSettings> all_types = {disc(Drive::differential), disc(Drive::holonomic),
                                              disc(Drive::ackermann),    cart(Drive::differential),
                                              cart(Drive::holonomic),    cart(Drive::ackermann)};

TEST_CASE("whatever a controller commands, its robot touches nothing that stands") {
  for (std::size_t i = 0; i < all_types.size(); ++i)
    for (int run = 0; run < draws(60); ++run) {
      Stream stream(7, "test.monitor.standing", i, run);
      RobotSettings type = all_types[i];
      const SimulationSettings settings = with_latency(type, run % 3 == 2);
      Scenario scenario = random_scenario(stream.next_u64(), 7.0, 6);
      const auto geometry = geometry_of(scenario);
      std::vector<dmrp_vec2> taken = {free_place(*geometry, stream, type.radius_m + 0.05, {}, 0.0)};
      scenario.robots = {robot({taken[0].x, taken[0].y, stream.uniform(-3.0, 3.0)}, dmrp_vec2{1, 1})};
      for (int other = 0; other < 4; ++other) {  // in the open, where no corner hides them
        taken.push_back(free_place(*geometry, stream, 0.6, taken, 1.3));
        if (other % 2 == 0)
          scenario.robots.push_back(
              robot({taken.back().x, taken.back().y, stream.uniform(-3.0, 3.0)}, dmrp_vec2{1, 1}));
        else
          scenario.tracks.push_back(walk(taken.back(), {0.0, 0.0}));
      }
      World world(scenario, type, settings, geometry, 1);
      RandomDriver driver(stream);
      INFO("type " << i << ", run " << run);
      double driven_m = 0.0;
      while (world.t_ns() < minute_ns / 3) {
        if (is_control_tick(world)) tick(world, driver.command());
        for (const dmrp_contact& contact : step(world)) {
          INFO("kind " << contact.kind << " with " << contact.b << " at " << world.t_ns());
          CHECK_FALSE(is_of_robot_0(contact));
        }
        driven_m += 0.02 * std::hypot(world.robots()[0].velocity.v_x, world.robots()[0].velocity.v_y);
      }
      CHECK(driven_m > 0.1);
    }
}

TEST_CASE("a robot that people walk into stands when they touch") {
  int touched = 0;
  for (std::size_t i = 0; i < all_types.size(); ++i)
    for (int run = 0; run < draws(60); ++run) {
      Stream stream(8, "test.monitor.walking", i, run);
      RobotSettings type = all_types[i];
      const SimulationSettings settings = with_latency(type, run % 3 == 2);
      Scenario scenario = empty_scenario(40, 40);
      scenario.robots = {robot({20, 20, stream.uniform(-3.0, 3.0)}, dmrp_vec2{1, 1})};
      for (int person = 0; person < 6; ++person) {  // each aims at the robot's place
        const double heading = stream.uniform(-3.0, 3.0);
        const double speed = stream.uniform(0.2, 1.6);
        const dmrp_vec2 target = {20.0 + stream.uniform(-1.0, 1.0), 20.0 + stream.uniform(-1.0, 1.0)};
        scenario.tracks.push_back(walk(target - stream.uniform(2.5, 12.0) * toolkit::from_angle(heading),
                                       speed * toolkit::from_angle(heading)));
      }
      World world(scenario, type, settings, geometry_of(scenario), 1);
      RandomDriver driver(stream);
      INFO("type " << i << ", run " << run);
      std::vector<bool> was_near(scenario.tracks.size());  // at the last control tick: the robot may leave it
      for (bool touches = false; !touches && world.t_ns() < minute_ns / 6;) {  // contact disturbs the robot's motion
        if (is_control_tick(world)) {
          for (std::size_t person = 0; person < was_near.size(); ++person)
            was_near[person] = gap_to_person(world, person) < monitor_gap_m;
          tick(world, driver.command());
        }
        const double speed = std::hypot(world.robots()[0].velocity.v_x, world.robots()[0].velocity.v_y);
        for (const dmrp_contact& contact : step(world)) {
          touches = true;
          if (was_near[contact.b]) continue;
          INFO("person " << contact.b << " at " << world.t_ns());
          CHECK(speed <= 0.05);
          ++touched;
        }
      }
    }
  CHECK(touched > draws(150));
}

TEST_CASE("a command that is safe is left as it is, to the bit") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({10, 10, 0}, dmrp_vec2{18, 10}), robot({10, 11.5, 0}, dmrp_vec2{18, 10})};
  World world(scenario, disc(Drive::differential), {}, geometry_of(scenario), 1);
  for (const dmrp_twist command : {dmrp_twist{0.8, 0.0, 0.0}, {0.1, 0.0, 0.3}, {9.0, 0.1, -7.0}, {-0.0, 0.0, 0.0}}) {
    const MonitoredCommand left = monitored(world, 0, command);
    CHECK(left.percent == 100);
    CHECK(left.command.v_x == command.v_x);
    CHECK(std::signbit(left.command.v_x) == std::signbit(command.v_x));
    CHECK(left.command.v_y == command.v_y);
    CHECK(left.command.omega == command.omega);
  }
}

TEST_CASE("a reduced command keeps the curve") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({19.6, 10, 0}, dmrp_vec2{18, 10})};  // 0.15 m from the wall
  World world(scenario, disc(Drive::differential), {}, geometry_of(scenario), 1);
  std::vector<std::uint32_t> seen;
  for (int i = 0; i < 40; ++i) {
    if (is_control_tick(world)) {
      const MonitoredCommand left = monitored(world, 0, {0.8, 0.0, 0.4});
      CHECK(left.command.omega == Approx(0.5 * left.command.v_x));
      CHECK(left.command.v_x == Approx(0.008 * left.percent));
      seen.push_back(left.percent);
      world.set_command(0, left.command);
    }
    step(world);
  }
  CHECK(seen.front() == 100);  // it stands, and a control period is short
  CHECK(std::find(seen.begin(), seen.end(), 25) != seen.end());
}

TEST_CASE("a robot that touches a wall can leave it, and come no nearer") {
  for (const double overlap_m : {0.0, 0.0015}) {
    Scenario scenario = empty_scenario(20, 20);
    scenario.robots = {robot({0.25 - overlap_m, 10, 0}, dmrp_vec2{18, 10})};
    World world(scenario, disc(Drive::holonomic), {}, geometry_of(scenario), 1);
    CHECK(monitored(world, 0, {0.8, 0.0, 0.0}).percent == 100);
    CHECK(monitored(world, 0, {0.0, 0.5, 0.0}).percent == 100);  // along the wall
    CHECK(monitored(world, 0, {0.0, 0.0, 1.0}).percent == 100);
    CHECK(monitored(world, 0, {-0.4, 0.0, 0.0}).percent == 0);
    CHECK(monitored(world, 0, {-0.01, 0.5, 0.0}).percent == 0);
  }
}

TEST_CASE("a robot of 0.25 m radius passes a door of 0.55 m, and a narrower one than its gap is shut") {
  for (const double width_m : {0.55, 0.51})
    for (const double aside_m : {0.0, 0.012}) {
      Scenario scenario = empty_scenario(8, 6);
      scenario.shapes = {box("south", {4, 0}, {4.2, 3 - 0.5 * width_m}),
                         box("north", {4, 3 + 0.5 * width_m}, {4.2, 6})};
      scenario.robots = {robot({2, 3 + aside_m, 0}, dmrp_vec2{7, 3})};
      World world(scenario, disc(Drive::differential), {}, geometry_of(scenario), 1);
      const double way_m = driven_m(world, {0.6, 0.0, 0.0});
      if (width_m > 0.52)
        CHECK(way_m > 5.0);  // to the wall behind
      else
        CHECK(way_m < 2.0);
    }
}

TEST_CASE("people move on as they do where the experiment tracks agents, and stand where it does not") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({10, 10, 0}, dmrp_vec2{18, 10})};
  scenario.tracks = {walk({10.7, 8.8}, {0.0, 1.2})};  // before the robot in a second
  for (const Tracking tracking : {Tracking::none, Tracking::visible}) {
    SimulationSettings settings;
    settings.tracking = tracking;
    World world(scenario, disc(Drive::differential), settings, geometry_of(scenario), 1);
    std::uint32_t least = 100;
    for (int i = 0; i <= 25; ++i) {
      if (is_control_tick(world)) {
        const MonitoredCommand left = monitored(world, 0, {0.8, 0.0, 0.0});
        least = std::min(least, left.percent);
        world.set_command(0, left.command);
      }
      step(world);
    }
    CHECK((least == 100) == (tracking == Tracking::none));
  }
}

TEST_CASE("what no sensor sees holds no robot back") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({10, 10, 0}, dmrp_vec2{18, 10})};
  scenario.tracks = {walk({9.53, 10}, {0.0, 0.0})};  // 0.02 m behind it
  RobotSettings type = disc(Drive::differential);
  World world(scenario, type, {}, geometry_of(scenario), 1);
  CHECK(monitored(world, 0, {-0.4, 0.0, 0.0}).percent < 100);
  type.lidar.field_of_view_rad = std::numbers::pi;
  World half_blind(scenario, type, {}, geometry_of(scenario), 1);
  CHECK(monitored(half_blind, 0, {-0.4, 0.0, 0.0}).percent == 100);
}

}  // namespace collision_monitor_test
