// SPDX-License-Identifier: MIT
// Crowds that start in a region, leave the world, or walk along recorded tracks.
#include <catch2/catch.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <map>
#include <set>
#include <stdexcept>

#include "core/people/crowd_lattice.hpp"
#include "tests/unit/core/people/sample_worlds.hpp"

namespace population_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr std::int64_t second_ns = 1'000'000'000;

// A room of 9 m x 9 m with an exit in the east.
Scenario room(std::uint32_t people) {
  Scenario scenario = empty_scenario(14, 10);
  scenario.shapes = {box("wall, low", {10, 0}, {10.2, 4.5}), box("wall, high", {10, 5.5}, {10.2, 10})};
  scenario.regions = {{"room", {0.5, 0.5}, {9.5, 9.5}}, {"out", {12, 0.5}, {13, 9.5}}};
  scenario.flows = {{"leaving", {0, 1}, people, FlowStart::from, false}};
  return scenario;
}

Track track(std::vector<Track::Point> points) {
  return {std::move(points)};
}

TEST_CASE("a crowd fills a region evenly, free and apart, up to nearly the closest packing") {
  Scenario scenario = room(150);
  scenario.shapes.push_back(circle("pillar", {5, 5}, 1.0));
  const auto geometry = geometry_of(scenario);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const World world = world_of(scenario, seed);
    REQUIRE(world.people().size() == 150);
    CHECK(nearest_pair(world.people()) >= 2.0 * body_radius_m + personal_gap_m - 1e-9);
    int west = 0;
    int south = 0;
    for (const dmrp_person& person : world.people()) {
      CHECK(geometry->disc_is_free(person.position, body_radius_m));
      CHECK(toolkit::contains(toolkit::Rectangle{{0.5, 0.5}, {9.5, 9.5}}, person.position));
      west += person.position.x < 5.0;
      south += person.position.y < 5.0;
    }
    CHECK(west == Approx(75).margin(15));
    CHECK(south == Approx(75).margin(15));
  }
  CHECK(world_of(scenario, 1).people()[0].position != world_of(scenario, 2).people()[0].position);

  // the closest packing of discs 0.45 m apart has 5.7 people a square metre: 461 in 81 m2
  CHECK(world_of(room(420)).people().size() == 420);
  CHECK_THROWS_WITH(world_of(room(600)), Catch::Contains("no room in region 'room' for 600 people"));
}

TEST_CASE("flows that start in the same or in overlapping regions share the space") {
  Scenario scenario = room(40);
  scenario.regions.push_back({"corner", {5.0, 5.0}, {9.5, 9.5}});
  scenario.flows.push_back({"too", {0, 1}, 40, FlowStart::from, false});
  scenario.flows.push_back({"from the corner", {2, 1}, 20, FlowStart::from, false});
  scenario.flows.push_back({"along", {0, 1}, 10});
  const World world = world_of(scenario);
  REQUIRE(world.people().size() == 110);
  CHECK(nearest_pair(world.people()) >= 2.0 * body_radius_m + personal_gap_m - 1e-9);
  for (std::size_t i = 0; i < 110; ++i) CHECK(world.people()[i].id == i);
  for (std::size_t i = 80; i < 100; ++i)
    CHECK(toolkit::contains(toolkit::Rectangle{{5.0, 5.0}, {9.5, 9.5}}, world.people()[i].position));
}

TEST_CASE("people answer to robots as their flow says, and so do those who take their places") {
  Scenario scenario = room(8);
  scenario.shapes.clear();
  scenario.flows[0].respawn = true;
  scenario.flows[0].reaction = DMRP_REACTION_SCARED;
  scenario.flows.push_back({"along", {0, 1}, 4});
  World world = world_of(scenario);
  const std::size_t slots = world.people().size();
  REQUIRE(slots == 12);
  std::set<std::uint64_t> ids;
  for (; world.t_ns() < 20 * second_ns; world.step(straight_on(world)))
    for (const dmrp_person& person : world.people()) {
      const bool of_first_flow = person.id % slots < 8;
      CHECK(person.reaction == (of_first_flow ? DMRP_REACTION_SCARED : DMRP_REACTION_UNSPECIFIED));
      ids.insert(person.id);
    }
  CHECK(*ids.rbegin() >= slots);  // somebody has left and was replaced
}

TEST_CASE("people who leave free their slots, the others keep their ids, until nobody is left") {
  Scenario scenario = room(30);
  scenario.shapes.clear();
  World world = world_of(scenario);
  std::set<std::uint64_t> there;
  for (const dmrp_person& person : world.people()) there.insert(person.id);
  std::map<std::uint64_t, dmrp_vec2> last;
  while (!world.is_deserted() && world.t_ns() < 60 * second_ns) {
    for (const dmrp_person& person : world.people()) last[person.id] = person.position;
    world.step(straight_on(world));
    REQUIRE(world.person_agents().size() == world.people().size());
    std::set<std::uint64_t> now;
    for (std::size_t i = 0; i < world.people().size(); ++i) {
      const dmrp_person& person = world.people()[i];
      now.insert(person.id);
      CHECK(there.count(person.id) == 1);
      CHECK(toolkit::distance(last[person.id], person.position) < 0.05);
      CHECK(world.person_agents()[i].id == person.id);
    }
    REQUIRE(now.size() == world.people().size());
    there = now;
  }
  CHECK(world.is_deserted());
  CHECK(world.people().empty());
  CHECK(world.t_ns() < 60 * second_ns);
}

TEST_CASE("the crowd at the beginning does not depend on the number of robots") {
  Scenario all = empty_scenario(30, 12);
  all.regions = {{"west", {0.5, 1}, {2.5, 11}}, {"east", {27.5, 1}, {29.5, 11}}};
  all.flows = {{"eastward", {0, 1}, 12}};
  for (int i = 0; i < 4; ++i) all.robots.push_back(robot({6.0 + 5.0 * i, 6.0, 0.0}, dmrp_vec2{25, 2.0 + i}));
  const Scenario none = without_robots(all);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World with = world_of(all, seed);
    const World without = world_of(none, seed);
    for (std::size_t i = 0; i < 12; ++i) {
      CHECK(with.people()[i].position == without.people()[i].position);
      CHECK(with.people()[i].target == without.people()[i].target);
      CHECK(with.people()[i].desired_speed == without.people()[i].desired_speed);
    }
  }
}

TEST_CASE("motion between the points of a track is linear") {
  const Track way = track({{0, {0, 0}}, {2 * second_ns, {2, 0}}, {3 * second_ns, {2, 2}}});
  CHECK(position_on(way, second_ns / 2) == dmrp_vec2{0.5, 0.0});
  CHECK(position_on(way, 2 * second_ns + second_ns / 4) == dmrp_vec2{2.0, 0.5});
  CHECK(position_on(way, -second_ns) == dmrp_vec2{0.0, 0.0});
  CHECK(position_on(way, 9 * second_ns) == dmrp_vec2{2.0, 2.0});
  CHECK(velocity_on(way, second_ns) == dmrp_vec2{1.0, 0.0});
  CHECK(velocity_on(way, 2 * second_ns) == dmrp_vec2{0.0, 2.0});
  CHECK(is_on_track(way, 0));
  CHECK(is_on_track(way, 3 * second_ns));
  CHECK_FALSE(is_on_track(way, 3 * second_ns + 1));
  CHECK(mean_speed(way) == Approx(4.0 / 3.0));
  CHECK(mean_speed(track({{5, {1, 1}}})) == 0.0);
}

TEST_CASE("recorded people appear and leave with their tracks and follow them exactly") {
  Scenario scenario = room(2);
  scenario.flows[0].respawn = true;
  scenario.tracks = {track({{second_ns, {2, 2}}, {4 * second_ns, {5, 2}}}),
                     track({{0, {9, 9}}, {second_ns / 2, {8.5, 9}}, {2 * second_ns, {8.5, 6}}})};
  World world = world_of(scenario);
  CHECK(person_count(scenario) == 4);
  REQUIRE(world.people().size() == 3);
  CHECK(world.people()[2].id == 3);
  CHECK(world.people()[2].velocity.x == Approx(-1.0));
  std::map<std::uint64_t, std::pair<std::int64_t, std::int64_t>> seen;  // by id: first and last time
  while (world.t_ns() < 6 * second_ns) {
    world.step(std::vector<dmrp_vec2>(world.people().size(), {3.0, 3.0}));
    const double t = 1e-9 * static_cast<double>(world.t_ns());
    for (const dmrp_person& person : world.people()) {
      seen.try_emplace(person.id, world.t_ns(), world.t_ns()).first->second.second = world.t_ns();
      if (person.id == 2) {
        CHECK(person.position.x == Approx(1.0 + t));
        CHECK(person.position.y == Approx(2.0));
        CHECK(person.velocity.x == Approx(1.0));
      }
    }
  }
  CHECK(seen.at(2) == std::pair(second_ns, 4 * second_ns));
  CHECK(seen.at(3).second == 2 * second_ns);
  CHECK(seen.at(0).second == 6 * second_ns);
  CHECK(world.people().size() == 2);
}

TEST_CASE("nobody starts on top of a recorded person") {
  Scenario scenario = room(60);
  for (const double x : {2.0, 4.0, 6.0, 8.0}) scenario.tracks.push_back(track({{0, {x, x}}, {second_ns, {x, x}}}));
  scenario.flows.push_back({"along", {0, 1}, 10});
  const World world = world_of(scenario);
  REQUIRE(world.people().size() == 74);
  CHECK(nearest_pair(world.people()) >= 2.0 * body_radius_m);
}

TEST_CASE("a world of recorded people is deserted after the last one left, not before the first one appears") {
  Scenario scenario = empty_scenario(10, 10);
  scenario.tracks = {track({{second_ns, {2, 2}}, {2 * second_ns, {3, 2}}})};
  World world = world_of(scenario);
  CHECK(world.people().empty());
  CHECK_FALSE(world.is_deserted());
  while (!world.is_deserted()) world.step(std::vector<dmrp_vec2>(world.people().size()));
  CHECK(world.t_ns() == 2 * second_ns + 20'000'000);
}

TEST_CASE("a recorded person walks through bodies without pushing them, and bodies stop at a recorded person") {
  Scenario scenario = empty_scenario(12, 6);
  scenario.robots = {robot({5, 3, 0}, dmrp_vec2{11, 3}), robot({9, 3, 3.14159265358979323846}, dmrp_vec2{1, 3})};
  scenario.tracks = {track({{0, {2, 3}}, {5 * second_ns, {7, 3}}, {15 * second_ns, {7, 3}}})};
  World world = world_of(scenario);
  bool touched = false;
  double deepest_m = 0.0;
  while (world.t_ns() < 15 * second_ns) {
    if (world.t_ns() >= 6 * second_ns)
      world.set_command(1, {0.8, 0.0, 0.0});  // toward the person, who stands at this time
    world.step(std::vector<dmrp_vec2>(1));
    for (const dmrp_contact& contact : world.contacts()) {
      if (contact.kind != DMRP_CONTACT_PERSON) continue;
      if (contact.a == 0) {
        touched = true;
        CHECK((contact.flags & DMRP_CONTACT_FAULT_B) != 0);
        CHECK((contact.flags & DMRP_CONTACT_FAULT_A) == 0);
      } else {
        deepest_m = std::max(deepest_m, contact.depth_m);
        CHECK((contact.flags & DMRP_CONTACT_FAULT_A) != 0);
      }
    }
    CHECK(world.people()[0].position.x == Approx(std::min(7.0, 2.0 + 1e-9 * static_cast<double>(world.t_ns()))));
  }
  CHECK(touched);
  CHECK(world.robots()[0].pose.x == 5.0);
  CHECK(world.robots()[1].pose.x == Approx(7.0 + 0.25 + body_radius_m).margin(0.01));
  CHECK(deepest_m > 0.001);
  CHECK(deepest_m < 0.002);
}

}  // namespace population_test
