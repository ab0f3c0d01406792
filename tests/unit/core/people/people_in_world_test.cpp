// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/rectangle.hpp>
#include <set>
#include <stdexcept>
#include <vector>

#include "tests/unit/core/people/sample_worlds.hpp"

namespace people_in_world_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

TEST_CASE("people start along their flows, clear of obstacles and each other, at the set speeds") {
  Scenario scenario = busy_hall(30);
  scenario.robots = {robot({5, 6, 0}, dmrp_vec2{25, 6}), robot({20, 3, 0}, dmrp_vec2{5, 3})};
  const auto geometry = geometry_of(scenario);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world(scenario, RobotSettings{}, SimulationSettings{}, geometry, seed);
    REQUIRE(world.people().size() == 30);
    std::set<std::uint64_t> ids;
    double west_most = 30.0;
    double east_most = 0.0;
    for (const dmrp_person& person : world.people()) {
      ids.insert(person.id);
      CHECK(geometry->disc_is_free(person.position, body_radius_m));
      CHECK(person.desired_speed >= 0.5);
      CHECK(person.desired_speed <= 2.0);
      CHECK(toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.target));
      for (const RobotState& state : world.robots())
        CHECK(toolkit::distance(person.position, toolkit::position(state.pose)) >= 1.5);
      for (const dmrp_person& other : world.people())
        if (&other != &person) CHECK(toolkit::distance(person.position, other.position) >= 2.0 * body_radius_m);
      west_most = std::min(west_most, person.position.x);
      east_most = std::max(east_most, person.position.x);
    }
    CHECK(ids.size() == 30);
    CHECK(west_most < 8.0);
    CHECK(east_most > 22.0);
  }
}

TEST_CASE("the crowd of a seed does not depend on the robots") {
  const Scenario without = busy_hall(10);
  Scenario with = without;
  with.robots = {robot({15, 2, 0}, dmrp_vec2{25, 6})};
  const World one(without, RobotSettings{}, SimulationSettings{}, geometry_of(without), 5);
  const World two(with, RobotSettings{}, SimulationSettings{}, geometry_of(with), 5);
  const World other(without, RobotSettings{}, SimulationSettings{}, geometry_of(without), 6);
  int moved = 0;
  int same_as_other = 0;
  for (std::size_t i = 0; i < one.people().size(); ++i) {
    CHECK(one.people()[i].desired_speed == two.people()[i].desired_speed);
    CHECK(one.people()[i].target == two.people()[i].target);
    if (one.people()[i].position != two.people()[i].position) {
      ++moved;
      CHECK(toolkit::distance(one.people()[i].position, {15, 2}) < 1.5 + 3.0);
    }
    if (one.people()[i].position == other.people()[i].position) ++same_as_other;
  }
  CHECK(moved <= 2);
  CHECK(same_as_other == 0);
}

TEST_CASE("people go from region to region, leave, and new ones start away from robots") {
  Scenario scenario = busy_hall(8);
  scenario.shapes.clear();
  scenario.robots = {robot({1.5, 6, 0}, dmrp_vec2{25, 6})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 3);
  std::set<std::uint64_t> ids;
  std::set<std::uint32_t> targets;
  bool begin_away = true;
  bool begin_in_first_region = true;
  for (int step = 0; step < 6000; ++step) {
    const std::vector<dmrp_person> before(world.people().begin(), world.people().end());
    world.step(straight_on(world));
    for (std::size_t i = 0; i < before.size(); ++i) {
      const dmrp_person& person = world.people()[i];
      targets.insert(person.target_id);
      ids.insert(person.id);
      if (person.id == before[i].id) continue;
      begin_away = begin_away && toolkit::distance(person.position, {1.5, 6}) >= 1.5;
      const Region& first = scenario.regions[i < 4 ? 0 : 2];
      begin_in_first_region =
          begin_in_first_region && toolkit::contains(toolkit::Rectangle{first.lower, first.upper}, person.position);
      CHECK(person.id % 8 == i);
    }
  }
  CHECK(world.people().size() == 8);
  CHECK(ids.size() > 20);
  CHECK(targets == std::set<std::uint32_t>{0, 1, 2});
  CHECK(begin_away);
  CHECK(begin_in_first_region);
}

TEST_CASE("a person without room to respawn keeps walking until there is room") {
  Scenario scenario = busy_hall(0);
  scenario.shapes.clear();
  scenario.regions = {{"gate", {1, 5}, {2, 6}}, {"east", {27.5, 1}, {29.5, 11}}};
  scenario.flows = {{"eastward", {0, 1}, 1}};
  scenario.robots = {robot({1.5, 5.5, 0}, dmrp_vec2{15, 5.5})};
  World world(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 3);
  for (int step = 0; step < 3000; ++step) world.step(straight_on(world));
  CHECK(world.people()[0].id == 0);
  CHECK(world.people()[0].position.x > 26.0);
  world.set_command(0, {0.8, 0.0, 0.0});
  for (int step = 0; step < 500; ++step) world.step(straight_on(world));
  CHECK(world.people()[0].id == 1);
}

TEST_CASE("more people than there is room for are refused") {
  Scenario scenario = empty_scenario(4, 4);
  scenario.regions = {{"west", {0, 0}, {1, 4}}, {"east", {3, 0}, {4, 4}}};
  scenario.flows = {{"across", {0, 1}, 60}};
  CHECK_THROWS_AS(World(scenario, RobotSettings{}, SimulationSettings{}, geometry_of(scenario), 1), std::runtime_error);
}

}  // namespace people_in_world_test
