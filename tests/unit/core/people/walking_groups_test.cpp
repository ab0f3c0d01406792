// SPDX-License-Identifier: MIT
// Flows whose people walk in groups: their division, first positions, and respawning.
#include "core/people/walking_groups.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/rectangle.hpp>
#include <map>
#include <set>

#include "core/people/crowd_lattice.hpp"
#include "tests/unit/core/people/sample_worlds.hpp"

namespace walking_groups_test {

using namespace dmrp;
using namespace dmrp::core;
using namespace dmrp::core::test;

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr double neighbors_m = 2.0 * body_radius_m + group_gap_m;  // between members at the beginning

// A hall of 30 m x 12 m with two pillars; everybody walks eastward.
Scenario hall(std::vector<Flow> flows) {
  Scenario scenario = empty_scenario(30, 12);
  scenario.shapes = {circle("pillar", {10, 6}, 0.8), circle("thin pillar", {20, 4}, 0.15)};
  scenario.regions = {{"west", {0.5, 1}, {2.5, 11}}, {"east", {27.5, 1}, {29.5, 11}}};
  scenario.flows = std::move(flows);
  return scenario;
}

using Members = std::map<std::uint32_t, std::vector<dmrp_person>>;

// By group, without people who walk alone.
Members members_of(const World& world) {
  Members members;
  for (const dmrp_person& person : world.people())
    if (person.group != 0) members[person.group].push_back(person);
  return members;
}

// The greatest distance between members in successive slots.
double longest_step(const std::vector<dmrp_person>& members) {
  double longest_m = 0.0;
  for (std::size_t i = 1; i < members.size(); ++i)
    longest_m = std::max(longest_m, toolkit::distance(members[i - 1].position, members[i].position));
  return longest_m;
}

void check_standing(const Scenario& scenario, const World& world) {
  const auto geometry = geometry_of(scenario);
  CHECK(nearest_pair(world.people()) >= 2.0 * body_radius_m + personal_gap_m - 1e-9);
  for (const dmrp_person& person : world.people()) {
    CHECK(geometry->disc_is_free(person.position, body_radius_m));
    CHECK(geometry->disc_is_free(person.target, body_radius_m));
    CHECK(toolkit::contains(toolkit::Rectangle{person.area_lower, person.area_upper}, person.target));
    for (const RobotTask& robot : scenario.robots)
      CHECK(toolkit::distance(person.position, {robot.start.x, robot.start.y}) >= 1.5);
  }
}

TEST_CASE("people form groups by slot, a remainder forms a smaller group, people alone have no group") {
  const auto groups = divide_into_groups({{"pairs", {0, 1}, 5, FlowStart::along, true, 2},
                                          {"singles", {0, 1}, 2},
                                          {"nobody", {0, 1}, 0, FlowStart::along, true, 3},
                                          {"triples", {0, 1}, 8, FlowStart::from, true, 3}});
  std::vector<std::vector<std::uint32_t>> found;
  for (const WalkingGroup& group : groups)
    found.push_back({group.flow, group.number, group.first_slot, group.size, group.id});
  CHECK(found == std::vector<std::vector<std::uint32_t>>{{0, 0, 0, 2, 1},
                                                         {0, 1, 2, 2, 2},
                                                         {0, 2, 4, 1, 0},
                                                         {1, 0, 5, 1, 0},
                                                         {1, 1, 6, 1, 0},
                                                         {3, 0, 7, 3, 3},
                                                         {3, 1, 10, 3, 4},
                                                         {3, 2, 13, 2, 5}});
}

TEST_CASE("a group stands side by side, from right to left, at most three in a row") {
  const auto check = [](const std::vector<dmrp_vec2>& found, const std::vector<dmrp_vec2>& expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(found[i].x == Approx(expected[i].x).margin(1e-12));
      CHECK(found[i].y == Approx(expected[i].y).margin(1e-12));
    }
  };
  check(formation(1, 1, 0.8, 1.0), {{0, 0}});
  check(formation(2, 2, 0.8, 0.0), {{0, -0.4}, {0, 0.4}});
  check(formation(2, 1, 0.8, 0.0), {{0.4, 0}, {-0.4, 0}});
  check(formation(3, 3, 1.0, 0.5 * 3.14159265358979323846), {{1, 0}, {0, 0}, {-1, 0}});
  check(formation(5, 3, 1.0, 0.0), {{0.5, -1}, {0.5, 0}, {0.5, 1}, {-0.5, -0.5}, {-0.5, 0.5}});
  CHECK(widest_row(2) == 2);
  CHECK(widest_row(7) == 3);
}

TEST_CASE("members of a group start side by side, apart from others, with one desired speed and targets in a row") {
  Scenario scenario = hall({{"pairs", {0, 1}, 10, FlowStart::along, true, 2},
                            {"singles", {0, 1}, 6},
                            {"triples", {1, 0}, 11, FlowStart::along, true, 3}});
  scenario.robots = {robot({6, 6, 0}, dmrp_vec2{25, 6}), robot({16, 7, 0}, dmrp_vec2{25, 3})};
  std::set<double> speeds;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const World world = world_of(scenario, seed);
    REQUIRE(world.people().size() == 27);
    check_standing(scenario, world);
    const Members members = members_of(world);
    CHECK(members.size() == 9);  // five pairs, three triples, the remaining two
    for (const auto& [group, people] : members) {
      CHECK(people.size() == (group <= 5 ? 2 : group <= 8 ? 3 : 2));
      CHECK(longest_step(people) <= neighbors_m + 1e-9);
      for (std::size_t i = 1; i < people.size(); ++i) {
        CHECK(people[i].id == people[i - 1].id + 1);
        CHECK(people[i].desired_speed == people[0].desired_speed);
        CHECK(people[i].target_id == people[0].target_id);
        CHECK(toolkit::distance(people[i].target, people[i - 1].target) == Approx(neighbors_m));
        // members do not have to swap sides; at most they start behind each other, on a diagonal way, because no row had
        // room
        const dmrp_vec2 from = people[i].position - people[i - 1].position;
        const dmrp_vec2 to = people[i].target - people[i - 1].target;
        CHECK(toolkit::dot(from, to) > -std::sqrt(0.5) * neighbors_m * neighbors_m - 1e-9);
      }
      speeds.insert(people[0].desired_speed);
    }
  }
  CHECK(speeds.size() == 450);
}

TEST_CASE("members start behind each other where there is no room for a row") {
  Scenario scenario = empty_scenario(40, 1);
  scenario.regions = {{"west", {0.5, 0.3}, {4, 0.7}}, {"east", {36, 0.3}, {39.5, 0.7}}};
  scenario.flows = {{"triples", {0, 1}, 12, FlowStart::along, true, 3}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const World world = world_of(scenario, seed);
    check_standing(scenario, world);
    for (const auto& [group, people] : members_of(world)) CHECK(longest_step(people) == Approx(neighbors_m));
  }
}

TEST_CASE("groups and single people share a region evenly, with members close together, up to a dense crowd") {
  for (const std::uint32_t each : {6u, 30u, 60u}) {  // 0.2 to 2.2 people a square metre
    Scenario scenario = empty_scenario(16, 10);
    scenario.shapes = {circle("pillar", {5, 5}, 1.0), box("screen", {2, 7.45}, {5, 7.5})};
    scenario.regions = {{"room", {0.5, 0.5}, {9.5, 9.5}}, {"out", {13, 0.5}, {15, 9.5}}};
    scenario.flows = {{"singles", {0, 1}, each / 2, FlowStart::from, false},
                      {"pairs", {0, 1}, each, FlowStart::from, false, 2},
                      {"triples", {0, 1}, each, FlowStart::from, false, 3}};
    const auto geometry = geometry_of(scenario);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const World world = world_of(scenario, seed);
      REQUIRE(world.people().size() == each * 5 / 2);
      check_standing(scenario, world);
      for (const auto& [group, people] : members_of(world)) {
        CHECK(longest_step(people) <= 1.5 * neighbors_m + 0.15);
        for (std::size_t i = 1; i < people.size(); ++i)
          CHECK(geometry->line_of_sight(people[i - 1].position, people[i].position));
      }
      int south = 0;
      for (const dmrp_person& person : world.people()) {
        CHECK(toolkit::contains(toolkit::Rectangle{{0.5, 0.5}, {9.5, 9.5}}, person.position));
        south += person.position.y < 5.0;
      }
      CHECK(south == Approx(1.25 * each).margin(0.25 * each + 3.0));
    }
  }
}

TEST_CASE("groups that start in a region stand in rows across their way") {
  Scenario scenario = hall({{"pairs", {0, 1}, 12, FlowStart::from, true, 2}});
  int across = 0;
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const auto& [group, people] : members_of(world_of(scenario, seed))) {
      const dmrp_vec2 apart = people[1].position - people[0].position;
      across += std::abs(apart.y) > std::abs(apart.x);
      ++all;
    }
  CHECK(all == 60);
  CHECK(across >= 54);  // exceptions are at the ends of rows
}

TEST_CASE("an error names a region or flow that is too small for its groups") {
  Scenario scenario = hall({{"triples", {0, 1}, 300, FlowStart::from, true, 3}});
  CHECK_THROWS_WITH(world_of(scenario), Catch::Contains("no room in region 'west' for 300 people"));
  scenario = empty_scenario(6, 1);
  scenario.regions = {{"west", {0.5, 0.3}, {1, 0.7}}, {"east", {5, 0.3}, {5.5, 0.7}}};
  scenario.flows = {{"crowd", {0, 1}, 20, FlowStart::along, true, 10}};
  CHECK_THROWS_WITH(world_of(scenario), Catch::Contains("no room along flow 'crowd' for 20 people in groups of 10"));
}

TEST_CASE("groups at the beginning do not depend on the number of robots") {
  Scenario all =
      hall({{"triples", {0, 1}, 12, FlowStart::along, true, 3}, {"from", {0, 1}, 6, FlowStart::from, true, 2}});
  for (int i = 0; i < 4; ++i) all.robots.push_back(robot({4.0 + 6.0 * i, 8.0, 0.0}, dmrp_vec2{25, 2.0 + i}));
  const Scenario none = without_robots(all);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World with = world_of(all, seed);
    const World without = world_of(none, seed);
    for (std::size_t i = 0; i < 18; ++i) {
      CHECK(with.people()[i].group == without.people()[i].group);
      CHECK(with.people()[i].position == without.people()[i].position);
      CHECK(with.people()[i].target == without.people()[i].target);
      CHECK(with.people()[i].desired_speed == without.people()[i].desired_speed);
    }
  }
}

TEST_CASE("members leave as they arrive and respawn together, as new people of a new group") {
  Scenario scenario = hall({{"triples", {0, 1}, 9, FlowStart::along, true, 3}, {"singles", {1, 0}, 3}});
  scenario.shapes.clear();
  World world = world_of(scenario, 3);
  struct Seen {
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
    std::uint32_t group = 0;
    dmrp_vec2 first{};
    double speed = 0.0;
  };
  std::map<std::uint64_t, Seen> seen;
  while (world.t_ns() < 120 * second_ns) {
    // one member of each group is slow, so that the others arrive long before
    std::vector<dmrp_vec2> velocities = straight_on(world);
    for (std::size_t i = 0; i < velocities.size(); ++i)
      if (world.people()[i].id % 12 % 3 == 1) velocities[i] = 0.6 * velocities[i];
    world.step(velocities);
    std::int64_t before = -1;
    for (std::size_t i = 0; i < world.people().size(); ++i) {
      const dmrp_person& person = world.people()[i];
      const auto slot = static_cast<std::int64_t>(person.id % 12);
      CHECK(slot > before);  // ordered by slot
      before = slot;
      CHECK(world.person_agents()[i].id == person.id);
      CHECK((person.group == 0) == (slot >= 9));
      const auto [at, is_new] = seen.try_emplace(person.id);
      if (is_new) at->second = {world.t_ns(), 0, person.group, person.position, person.desired_speed};
      at->second.last_ns = world.t_ns();
      CHECK(at->second.group == person.group);
    }
    CHECK(world.people().size() >= 3);
    CHECK_FALSE(world.is_deserted());
  }
  int returns = 0;
  for (const auto& [id, one] : seen) {
    if (id % 12 >= 9) continue;
    CHECK(one.group == 1 + id % 12 / 3 + 3 * (id / 12));
    const auto companion = seen.find(id - id % 12 % 3);
    REQUIRE(companion != seen.end());
    CHECK(companion->second.speed == one.speed);
    if (id < 12) continue;
    ++returns;
    CHECK(companion->second.first_ns == one.first_ns);
    CHECK(toolkit::distance(companion->second.first, one.first) < 2.0 * neighbors_m + 0.1);
    CHECK(toolkit::contains(toolkit::Rectangle{{0.5, 1}, {2.5, 11}}, one.first));
    // in the step in which the last member of the previous group left
    std::int64_t last_ns = 0;
    const std::uint64_t first_before = id - 12 - id % 12 % 3;
    for (std::uint64_t other = first_before; other < first_before + 3; ++other)
      last_ns = std::max(last_ns, seen.at(other).last_ns);
    CHECK(one.first_ns == last_ns + 20'000'000);
    CHECK(seen.at(first_before).last_ns < seen.at(first_before + 1).last_ns - second_ns);
  }
  CHECK(returns >= 18);
}

TEST_CASE("a group waits outside until there is room for all of it") {
  Scenario scenario = empty_scenario(20, 6);
  scenario.regions = {{"west", {0.5, 2}, {1.5, 4}}, {"east", {18, 1}, {19.5, 5}}};
  scenario.flows = {{"pair", {0, 1}, 2, FlowStart::along, true, 2}};
  scenario.robots = {robot({1, 3, 0}, dmrp_vec2{18, 5})};
  World world = world_of(scenario);
  while (world.t_ns() < 40 * second_ns) world.step(straight_on(world));
  CHECK(world.people().empty());
  CHECK_FALSE(world.is_deserted());
  while (world.t_ns() < 50 * second_ns) {
    world.set_command(0, {0.5, 0.0, 0.0});
    world.step(straight_on(world));
  }
  REQUIRE(world.people().size() == 2);
  CHECK(world.people()[0].id == 2);
  CHECK(world.people()[1].id == 3);
}

TEST_CASE("members who leave the world leave one by one, until nobody is left") {
  Scenario scenario = hall({{"pairs", {0, 1}, 7, FlowStart::from, false, 2}});
  World world = world_of(scenario);
  while (!world.is_deserted() && world.t_ns() < 90 * second_ns) {
    world.step(straight_on(world));
    for (const dmrp_person& person : world.people()) CHECK(person.id < 7);
  }
  CHECK(world.is_deserted());
}

TEST_CASE("members pass a region independently, to targets in a row") {
  Scenario scenario = hall({{"pair", {0, 2, 1}, 2, FlowStart::from, false, 2}});
  scenario.shapes.clear();
  scenario.regions.push_back({"middle", {14, 5}, {16, 7}});
  World world = world_of(scenario, 4);
  bool parted = false;
  while (world.people().size() == 2) {
    std::vector<dmrp_vec2> velocities = straight_on(world);
    velocities[1] = 0.5 * velocities[1];
    world.step(velocities);
    if (world.people().size() < 2) break;
    const bool first_on = world.people()[0].target_id == 1;
    const bool second_on = world.people()[1].target_id == 1;
    if (first_on && !second_on) parted = true;
    if (first_on == second_on)
      CHECK(toolkit::distance(world.people()[0].target, world.people()[1].target) == Approx(neighbors_m));
  }
  CHECK(parted);
}

}  // namespace walking_groups_test
