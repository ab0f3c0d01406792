// SPDX-License-Identifier: MIT
// Motion of robots and people: exact arcs, limits, solid bodies.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <numbers>

#include "core/scene/robot_task.hpp"
#include "core/world/motion_limits.hpp"
#include "core/world/unicycle.hpp"
#include "core/world/world.hpp"
#include "tests/unit/core/sample_scenarios.hpp"

namespace motion_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr double pi = std::numbers::pi;

World make_world(const Scenario& scenario, std::uint64_t seed = 1) {
  return World(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), seed);
}

// Adds one flow across the scenario, of people with bodies of 0.3 m. The population chooses their positions.
void add_people(Scenario& scenario, std::uint32_t count) {
  scenario.people.radius_m = 0.3;
  scenario.regions = {{"west", scenario.lower, {scenario.lower.x + 1.5, scenario.upper.y}},
                      {"east", {scenario.upper.x - 1.5, scenario.lower.y}, scenario.upper}};
  scenario.flows = {{"across", {0, 1}, count}};
}

std::vector<dmrp_vec2> standing(const World& world) {
  return std::vector<dmrp_vec2>(world.people().size());
}

// Moves one person straight to the place; all others stand.
void walk_to(World& world, std::size_t person, dmrp_vec2 place) {
  for (int i = 0; i < 2000; ++i) {
    const dmrp_vec2 way = place - world.people()[person].position;
    std::vector<dmrp_vec2> velocities = standing(world);
    velocities[person] = toolkit::norm(way) < 0.02 ? way / 0.02 : toolkit::normalized(way);
    world.step(velocities);
  }
}

TEST_CASE("a quarter of a circle ends where geometry says") {
  const dmrp_pose end = move({0.0, 0.0, 0.0}, {1.0, 0.0, 0.5 * pi}, 1.0);
  CHECK(end.x == Approx(2.0 / pi));
  CHECK(end.y == Approx(2.0 / pi));
  CHECK(end.theta == Approx(0.5 * pi));
}

TEST_CASE("arcs agree with their closed form and straight lines are their limit") {
  toolkit::Stream stream(7, "test.unicycle");
  for (int i = 0; i < 1000; ++i) {
    const dmrp_pose start = {stream.uniform(-5, 5), stream.uniform(-5, 5), stream.uniform(-pi, pi)};
    const double v = stream.uniform(-2, 2);
    const double omega = stream.uniform(0.05, 3.0) * (stream.chance(0.5) ? 1 : -1);
    const double t = stream.uniform(0.01, 2.0);
    const dmrp_pose end = move(start, {v, 0.0, omega}, t);
    CHECK(end.x == Approx(start.x + v / omega * (std::sin(start.theta + omega * t) - std::sin(start.theta))));
    CHECK(end.y == Approx(start.y - v / omega * (std::cos(start.theta + omega * t) - std::cos(start.theta))));
    CHECK(std::abs(toolkit::difference(end.theta, start.theta + omega * t)) < 1e-12);

    const dmrp_pose nearly = move(start, {v, 0.0, 1e-9}, t);
    const dmrp_pose straight = move(start, {v, 0.0, 0.0}, t);
    CHECK(nearly.x == Approx(straight.x).margin(1e-8));
    CHECK(straight.x == Approx(start.x + v * t * std::cos(start.theta)));
    CHECK(straight.y == Approx(start.y + v * t * std::sin(start.theta)));
  }
}

TEST_CASE("small steps along an arc add up to the arc") {
  dmrp_pose pose = {1.0, 2.0, 3.0};
  for (int i = 0; i < 1000; ++i) pose = move(pose, {0.8, 0.1, 0.7}, 0.02);
  const dmrp_pose at_once = move({1.0, 2.0, 3.0}, {0.8, 0.1, 0.7}, 20.0);
  CHECK(pose.x == Approx(at_once.x));
  CHECK(pose.y == Approx(at_once.y));
  CHECK(std::abs(toolkit::difference(pose.theta, at_once.theta)) < 1e-9);
  CHECK(std::abs(pose.theta) <= pi);
}

TEST_CASE("commands are clipped to the limits and followed within the accelerations") {
  const dmrp_limits limits = limits_of(RobotSettings{});
  const dmrp_twist clipped = clip_to_limits({5.0, 1.0, -3.0}, limits);
  CHECK(clipped.v_x == 0.8);
  CHECK(clipped.v_y == 0.0);
  CHECK(clipped.omega == -1.0);
  CHECK(clip_to_limits({-1.0, 0.0, 0.0}, limits).v_x == 0.0);

  const dmrp_twist faster = track({0.1, 0.0, 0.0}, {0.8, 0.0, -1.0}, limits, 0.02);
  CHECK(faster.v_x == Approx(0.12));
  CHECK(faster.omega == Approx(-0.02));
  const dmrp_twist there = track({0.79, 0.0, 0.5}, {0.8, 0.0, 0.51}, limits, 0.02);
  CHECK(there.v_x == 0.8);
  CHECK(there.omega == 0.51);
}

TEST_CASE("a free heading at the start follows the dominant axis toward the goal") {
  CHECK(start_of(robot({0, 0, any_heading}, dmrp_vec2{-5, 2})).theta == Approx(pi));
  CHECK(start_of(robot({0, 0, any_heading}, dmrp_vec2{1, -4})).theta == Approx(-0.5 * pi));
  CHECK(start_of(robot({0, 0, any_heading}, dmrp_vec2{3, 3})).theta == 0.0);
  CHECK(start_of(robot({0, 0, 0.3}, dmrp_vec2{-5, 2})).theta == 0.3);
}

TEST_CASE("a robot accelerates to its command and drives on") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{18, 5})};
  World world = make_world(scenario);
  CHECK(world.set_command(0, {2.0, 0.0, 0.0}).v_x == 0.8);
  for (int i = 0; i < 100; ++i) world.step({});
  // 0.8 s of speeding up in steps of 0.02 m/s, then 1.2 s at 0.8 m/s
  CHECK(world.robots()[0].velocity.v_x == Approx(0.8));
  CHECK(world.robots()[0].pose.x == Approx(5.0 + 0.02 * 0.02 * (40 * 41 / 2) + 60 * 0.016));
  CHECK(world.t_ns() == 2'000'000'000);
}

TEST_CASE("a robot that drives at a wall stops there, can turn and can leave") {
  Scenario scenario = empty_scenario(10, 10);
  scenario.shapes = {box("wall", {6, 0}, {7, 10})};
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{1, 5})};
  World world = make_world(scenario);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 200; ++i) world.step({});
  REQUIRE(world.contacts().size() == 1);
  const dmrp_contact contact = world.contacts()[0];
  CHECK(contact.kind == DMRP_CONTACT_STATIC);
  CHECK(contact.a == 0);
  CHECK(contact.b == 0);
  CHECK(contact.depth_m > 0.001);
  CHECK(contact.depth_m < 0.002);
  CHECK(contact.point.x == Approx(6.0).margin(0.002));
  CHECK(contact.point.y == Approx(5.0).margin(1e-9));
  CHECK(world.robots()[0].velocity.v_x == Approx(0.0).margin(1e-9));

  // it can turn in place, and driving away ends the contact
  world.set_command(0, {0.0, 0.0, 1.0});
  for (int i = 0; i < 150; ++i) world.step({});
  CHECK(world.robots()[0].pose.theta > 2.0);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 25; ++i) world.step({});
  CHECK(world.contacts().empty());
  CHECK(world.robots()[0].pose.x < 5.74);
}

TEST_CASE("along a wall, only the part of a motion toward the wall is lost") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.shapes = {box("wall", {0, 10}, {20, 11})};
  scenario.robots = {robot({5, 9.7, pi / 6}, dmrp_vec2{1, 5})};
  World world = make_world(scenario);
  // the wall takes away 1/4 of the speed in every step (the share along the robot's direction is cos^2)
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 100; ++i) world.step({});
  const RobotState before = world.robots()[0];
  world.step({});
  const RobotState after = world.robots()[0];
  CHECK(after.pose.y == Approx(before.pose.y).margin(1e-6));
  const double driven_m = (before.velocity.v_x + 0.02) * 0.02;
  CHECK(after.pose.x - before.pose.x == Approx(driven_m * std::cos(pi / 6)).epsilon(1e-4));
  CHECK(after.velocity.v_x == Approx((before.velocity.v_x + 0.02) * 0.75).epsilon(1e-4));
  CHECK(after.pose.theta == before.pose.theta);
}

TEST_CASE("robots neither push nor are pushed") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{18, 5}), robot({8, 5, 0}, dmrp_vec2{18, 5})};
  add_people(scenario, 1);
  World world = make_world(scenario);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int i = 0; i < 300; ++i) world.step(standing(world));
  CHECK(world.robots()[1].pose.x == 8.0);
  CHECK(world.robots()[0].pose.x == Approx(7.5).margin(0.002));
  REQUIRE(world.contacts().size() == 1);
  CHECK(world.contacts()[0].kind == DMRP_CONTACT_ROBOT);

  // the person walks at the second robot and stays in front of it
  for (int i = 0; i < 1500; ++i) {
    const dmrp_vec2 way = dmrp_vec2{8.0, 5.0} - world.people()[0].position;
    world.step(std::vector<dmrp_vec2>{toolkit::normalized(way) * 1.2});
  }
  CHECK(world.robots()[1].pose.x == 8.0);
  CHECK(world.robots()[1].pose.y == 5.0);
  CHECK(toolkit::distance(world.people()[0].position, {8.0, 5.0}) == Approx(0.55).margin(0.002));

  // the first robot drives at the person from the other side
  const dmrp_vec2 before = world.people()[0].position;
  for (int i = 0; i < 300; ++i) world.step(standing(world));
  CHECK(world.people()[0].position == before);
}

TEST_CASE("people push people, each bears half, but never into a robot or a wall") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({12, 5, 0}, dmrp_vec2{18, 5})};
  add_people(scenario, 2);
  World world = make_world(scenario);
  walk_to(world, 0, {8.0, 5.0});
  walk_to(world, 1, {9.0, 5.0});

  // the contact begins after 0.4 m; from then on, both move at half of the speed
  const std::vector<dmrp_vec2> eastward = {{1.0, 0.0}, {0.0, 0.0}};
  for (int i = 0; i < 100; ++i) world.step(eastward);
  CHECK(world.people()[1].velocity.x == Approx(0.5));
  CHECK(world.people()[0].velocity.x == Approx(0.5));
  CHECK(world.people()[1].position.x == Approx(9.8).margin(0.01));
  for (int i = 0; i < 300; ++i) world.step(eastward);
  CHECK(world.people()[1].position.x == Approx(12.0 - 0.55).margin(0.005));
  CHECK(world.robots()[0].pose.x == 12.0);

  walk_to(world, 1, {12.0, 0.6});
  walk_to(world, 0, {12.0, 1.6});
  for (int i = 0; i < 300; ++i) world.step(std::vector<dmrp_vec2>{{0.0, -1.0}, {0.0, 0.0}});
  CHECK(world.people()[1].position.y == Approx(0.3).margin(0.002));
  CHECK(world.people()[0].position.y == Approx(0.9).margin(0.004));
}

TEST_CASE("two robots that drive at each other meet in the middle") {
  Scenario scenario = empty_scenario(20, 20);
  scenario.robots = {robot({5, 5, 0}, dmrp_vec2{18, 5}), robot({8, 5, pi}, dmrp_vec2{1, 5})};
  World world = make_world(scenario);
  for (int i = 0; i < 300; ++i) {
    world.set_command(0, {0.8, 0.0, 0.0});
    world.set_command(1, {0.8, 0.0, 0.0});
    world.step({});
  }
  CHECK(world.robots()[0].pose.x == Approx(6.25).margin(0.002));
  CHECK(world.robots()[1].pose.x == Approx(6.75).margin(0.002));
  REQUIRE(world.contacts().size() == 1);
  CHECK((world.contacts()[0].flags & DMRP_CONTACT_FAULT_A) != 0);
  CHECK((world.contacts()[0].flags & DMRP_CONTACT_FAULT_B) != 0);
}

// Random commands for robots and people in a random world. Checks all pairs at every step.
class Chaos {
 public:
  explicit Chaos(std::uint64_t seed) : stream_(seed, "test.chaos"), scenario_(random_scenario(seed, 14.0, 22)) {
    const auto geometry = geometry_of(scenario_);
    std::vector<dmrp_vec2> taken;
    for (int i = 0; i < 5; ++i) {
      taken.push_back(free_place(*geometry, stream_, 0.26, taken, 0.6));
      scenario_.robots.push_back(
          robot({taken.back().x, taken.back().y, stream_.uniform(-pi, pi)}, dmrp_vec2{-100.0, -100.0}));
    }
    add_people(scenario_, 6);
    world_ = std::make_unique<World>(scenario_, settings_, SimulationSettings{}, geometry, seed);
    velocities_ = standing(*world_);
  }

  void step() {
    for (std::uint32_t i = 0; i < scenario_.robots.size(); ++i)
      if (stream_.chance(0.02)) world_->set_command(i, {stream_.uniform(-1, 3), 0.0, stream_.uniform(-2, 2)});
    for (dmrp_vec2& velocity : velocities_)
      if (stream_.chance(0.02)) velocity = stream_.uniform(0.0, 5.0) * toolkit::from_angle(stream_.uniform(-pi, pi));
    before_.assign(world_->robots().begin(), world_->robots().end());
    world_->step(velocities_);
  }

  // The greatest speed, turn rate and acceleration relative to their limits; 1 at the limit.
  double limits_used() const {
    double used = 0.0;
    for (std::size_t i = 0; i < before_.size(); ++i) {
      const dmrp_twist now = world_->robots()[i].velocity;
      used = std::max({used, now.v_x / settings_.v_max, now.v_x < 0.0 ? 2.0 : 0.0,
                       std::abs(now.omega) / settings_.omega_max,
                       (now.v_x - before_[i].velocity.v_x) / (settings_.a_max * 0.02),
                       std::abs(now.omega - before_[i].velocity.omega) / (settings_.alpha_max * 0.02)});
    }
    return used;
  }

  double deepest_overlap() const {
    const std::vector<std::pair<dmrp_vec2, double>> discs = all_discs();
    double deepest = 0.0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      deepest = std::max(deepest, depth_in_statics(discs[i].first, discs[i].second));
      for (std::size_t j = 0; j < i; ++j)
        deepest = std::max(deepest, discs[i].second + discs[j].second - distance(discs[i].first, discs[j].first));
    }
    return deepest;
  }

  // The number of robots' contacts, by exhaustive search.
  std::size_t contacts_expected() const {
    const StaticGeometry& geometry = world_->geometry();
    const std::vector<std::pair<dmrp_vec2, double>> discs = all_discs();
    std::size_t count = 0;
    for (std::size_t i = 0; i < world_->robots().size(); ++i) {
      const auto& [center, radius] = discs[i];
      for (const dmrp_shape& shape : geometry.sdk_shapes())
        if (radius - toolkit::signed_distance(shape, center) > 0.001) ++count;
      if (radius - toolkit::depth(geometry.rectangle(), center) > 0.001) ++count;
      for (std::size_t j = i + 1; j < discs.size(); ++j)
        if (radius + discs[j].second - distance(center, discs[j].first) > 0.001) ++count;
    }
    return count;
  }

  const World& world() const { return *world_; }

 private:
  static double distance(dmrp_vec2 a, dmrp_vec2 b) { return toolkit::distance(a, b); }

  std::vector<std::pair<dmrp_vec2, double>> all_discs() const {
    std::vector<std::pair<dmrp_vec2, double>> discs;
    for (const RobotState& state : world_->robots())
      discs.emplace_back(toolkit::position(state.pose), settings_.radius_m);
    for (const dmrp_person& person : world_->people()) discs.emplace_back(person.position, person.radius_m);
    return discs;
  }

  double depth_in_statics(dmrp_vec2 center, double radius_m) const {
    double deepest = radius_m - toolkit::depth(world_->geometry().rectangle(), center);
    for (const dmrp_shape& shape : world_->geometry().sdk_shapes())
      deepest = std::max(deepest, radius_m - toolkit::signed_distance(shape, center));
    return deepest;
  }

  toolkit::Stream stream_;
  Scenario scenario_;
  RobotSettings settings_;
  std::unique_ptr<World> world_;
  std::vector<dmrp_vec2> velocities_;
  std::vector<RobotState> before_;
};

// FNV-1a over the bits of everything that moves.
std::uint64_t fingerprint(const World& world) {
  std::uint64_t hash = 14695981039346656037u;
  const auto add = [&hash](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 1099511628211u;
  };
  for (const RobotState& state : world.robots()) {
    for (const double value : {state.pose.x, state.pose.y, state.pose.theta, state.velocity.v_x, state.velocity.omega})
      add(value);
  }
  for (const dmrp_person& person : world.people())
    for (const double value : {person.position.x, person.position.y, person.velocity.x}) add(value);
  for (const dmrp_contact& contact : world.contacts()) add(contact.depth_m + contact.flags);
  return hash;
}

TEST_CASE("bodies stay solid and limits hold for random commands") {
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    Chaos chaos(seed);
    double deepest = 0.0;
    double limits_used = 0.0;
    std::size_t contacts = 0;
    bool contacts_agree = true;
    for (int step = 0; step < 3000; ++step) {
      chaos.step();
      deepest = std::max(deepest, chaos.deepest_overlap());
      limits_used = std::max(limits_used, chaos.limits_used());
      contacts += chaos.world().contacts().size();
      contacts_agree = contacts_agree && chaos.world().contacts().size() == chaos.contacts_expected();
    }
    INFO("seed " << seed);
    CHECK(deepest < 0.002);
    CHECK(limits_used < 1.0 + 1e-9);
    CHECK(contacts > 100);
    CHECK(contacts_agree);
  }
}

TEST_CASE("equal worlds evolve identically, to the bit") {
  Chaos one(42);
  Chaos two(42);
  Chaos other(43);
  for (int step = 0; step < 1000; ++step) {
    one.step();
    two.step();
    other.step();
    REQUIRE(fingerprint(one.world()) == fingerprint(two.world()));
  }
  CHECK(fingerprint(one.world()) != fingerprint(other.world()));
}

}  // namespace motion_test
