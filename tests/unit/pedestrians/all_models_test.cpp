// SPDX-License-Identifier: MIT
// The properties that all models share.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

namespace all_models_test {

using namespace dmrp::test;

// People on a lattice between the walls, with this density and random targets.
std::vector<dmrp_person> packed_people(const WalkingWorld& world, double people_per_m2, dmrp::toolkit::Stream& chance) {
  const dmrp_vec2 size = world.c().upper;
  const double pitch_m = 1.0 / std::sqrt(people_per_m2);
  const int columns = static_cast<int>(size.x / pitch_m);
  const int rows = static_cast<int>(size.y / pitch_m);
  std::vector<dmrp_person> people;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const dmrp_vec2 at = {(column + 0.5) * size.x / columns, (row + 0.5) * size.y / rows};
      people.push_back(
          person(people.size() + 1, at, anywhere(world, chance), chance.truncated_normal(1.2, 0.2, 0.5, 2.0)));
      people.back().radius_m = 0.22;
    }
  }
  return people;
}

// How often people who wait before a door of 1 m turn back: turns of their motion by more than a right angle, over
// person-seconds within 3 m of it.
double turns_a_second_before_door(const std::string& model, const char* reactions) {
  const WalkingWorld world({12.0, 8.0}, {{{8.0, 0.0}, {8.2, 3.5}}, {{8.0, 4.5}, {8.2, 8.0}}});
  const dmrp_vec2 door = {8.1, 4.0};
  Walk walk(world, "dmrp.pedestrian." + model, {{"reactions", reactions}});
  dmrp::toolkit::Stream chance(1, "door");
  for (std::uint64_t id = 0; id < 40; ++id) {
    const dmrp_vec2 at = {2.4 + 0.7 * static_cast<double>(id % 8), 1.0 + 0.8 * static_cast<double>(id / 8)};
    walk.people.push_back(person(id, at, {11.5, 4.0}, chance.truncated_normal(1.34, 0.26, 0.5, 2.0)));
    walk.people.back().radius_m = 0.2;
    walk.people.back().target_id = 1;
  }
  std::vector<dmrp_vec2> before(walk.people.size());  // the last motion
  double turns = 0.0;
  double waits_s = 0.0;
  walk.until(25.0, [&] {
    for (const dmrp_person& each : walk.people) {
      const bool waits = each.position.x < 7.8 && dmrp::toolkit::distance(each.position, door) < 3.0;
      if (waits) waits_s += Walk::step_s;
      if (dmrp::toolkit::norm(each.velocity) < 0.02) continue;  // stands
      if (waits && dmrp::toolkit::dot(each.velocity, before[each.id]) < 0.0) turns += 1.0;
      before[each.id] = each.velocity;
    }
    return false;
  });
  REQUIRE(waits_s > 200.0);
  return turns / waits_s;
}

TEST_CASE("people who wait before a door do not turn to and fro") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  CHECK(turns_a_second_before_door(model, "on") < 2.0);
  if (model == "collision_free_speed") CHECK(turns_a_second_before_door(model, "off") < 2.0);
}

TEST_CASE("models walk on a grid of 0.25 m for the scenario's largest person") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  const WalkingWorld world({4.0, 4.0}, {});
  const Walk walk(world, "dmrp.pedestrian." + model);
  CHECK(walk.asked_grid().resolution_m == 0.25);
  CHECK(walk.asked_grid().radius_m == world.c().person_radius_m);
}

TEST_CASE("a lone person walks at the desired speed and stops at the target") {
  const std::string model = GENERATE("orca", "collision_free_speed");  // social force relaxes toward both
  CAPTURE(model);
  const WalkingWorld world({44.0, 2.0}, {});
  Walk walk(world, "dmrp.pedestrian." + model);
  walk.people = {person(1, {1.0, 1.0}, {43.0, 1.0}, 1.33)};
  REQUIRE(walk.until(60.0, [&] { return walk.people[0].position.x >= 41.0; }));
  CHECK(walk.t_s() == Approx(40.0 / 1.33).margin(0.1));
  walk_for(walk, 3.0);
  CHECK(dmrp::toolkit::distance(walk.people[0].position, walk.people[0].target) < 1e-3);
}

TEST_CASE("two people pass each other head-on without touching") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const double width_m = GENERATE(2.0, 10.0);
  const double aside = GENERATE(0.0, 1e-6, 0.1, -0.3);
  CAPTURE(model, width_m, aside);
  const WalkingWorld world({24.0, width_m}, {});
  Walk walk(world, "dmrp.pedestrian." + model);
  const double y = 0.5 * width_m;
  walk.people = {person(1, {2.0, y}, {22.0, y}), person(2, {22.0, y + aside}, {2.0, y + aside})};
  double least = 100.0;
  REQUIRE(walk.until(30.0, [&] {
    least = std::min(least, least_gap(walk.people));
    return all_arrived(walk.people);
  }));
  CHECK(least >= 0.0);
}

TEST_CASE("people walk around a box to a target behind it") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const double y = GENERATE(5.0, 4.3, 6.9);
  CAPTURE(model, y);
  const WalkingWorld world({24.0, 10.0}, {{{10.0, 3.0}, {12.0, 7.0}}});
  Walk walk(world, "dmrp.pedestrian." + model);
  walk.people = {person(1, {2.0, y}, {22.0, 5.0})};
  double clearance = 100.0;
  REQUIRE(walk.until(22.0, [&] {
    clearance = std::min(clearance, world.clearance(walk.people[0].position));
    return arrived(walk.people[0]);
  }));
  CHECK(clearance >= 0.3 - 1e-6);
}

TEST_CASE("with an awareness of 0, people walk as if there were no robots") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  const WalkingWorld world({24.0, 10.0}, {});
  Walk with(world, "dmrp.pedestrian." + model, {{"robot_awareness", 0.0}});
  Walk without(world, "dmrp.pedestrian." + model);
  with.people = without.people = {person(1, {2.0, 5.0}, {22.0, 5.0}), person(2, {8.0, 5.2}, {2.0, 5.0})};
  with.robots = {robot(0, {12.0, 7.0}), robot(1, {6.0, 6.5}, {0.5, 0.0})};
  for (int i = 0; i < 400; ++i) {
    with.step();
    without.step();
    for (std::size_t p = 0; p < 2; ++p) REQUIRE(with.people[p].position == without.people[p].position);
  }
}

TEST_CASE("the same seed gives the same walk, whatever the instance computed before") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  // social force is deterministic without this noise
  const ParamOverrides params = model == "social_force" ? ParamOverrides{{"motion_noise", 0.1}} : ParamOverrides{};
  const WalkingWorld world({20.0, 20.0}, {{{5.0, 5.0}, {7.0, 6.0}}});
  const WalkingWorld another({10.0, 10.0}, {});
  const auto people_after_walk = [&](Walk& walk) {
    walk.people = random_people(world, 30, 3);
    walk_for(walk, 5.0);
    return walk.people;
  };
  Walk first(world, "dmrp.pedestrian." + model, params, 42);
  Walk second(world, "dmrp.pedestrian." + model, params, 42);
  Walk other_seed(world, "dmrp.pedestrian." + model, params, 43);
  second.restart(another, 1);
  second.people = {person(9, {1.0, 1.0}, {9.0, 9.0})};
  walk_for(second, 2.0);
  second.restart(world, 42);

  const auto expected = people_after_walk(first);
  const auto repeated = people_after_walk(second);
  second.restart(world, 42);
  const auto on_the_same_world = people_after_walk(second);
  const auto differing = people_after_walk(other_seed);
  int differ = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(expected[i].position == repeated[i].position);
    CHECK(expected[i].position == on_the_same_world[i].position);
    if (expected[i].position != differing[i].position) ++differ;
  }
  CHECK(differ > 15);  // some have arrived
}

TEST_CASE("below 4 people per square metre nobody overlaps by 5 cm or enters a wall") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const double people_per_m2 = GENERATE(0.5, 1.0, 2.0, 3.0, 3.8);
  CAPTURE(model, people_per_m2);
  const WalkingWorld world({5.0, 5.0}, {});
  Walk walk(world, "dmrp.pedestrian." + model);
  dmrp::toolkit::Stream chance(5, "targets");
  walk.people = packed_people(world, people_per_m2, chance);
  double least = 100.0;
  double clearance = 100.0;
  walk.until(10.0, [&] {
    least = std::min(least, least_gap(walk.people));
    for (dmrp_person& p : walk.people) {
      clearance = std::min(clearance, world.clearance(p.position));
      if (arrived(p)) {
        p.target = anywhere(world, chance);
        p.target_id += 1000;
        p.area_lower = {p.target.x - 0.2, p.target.y - 0.2};
        p.area_upper = {p.target.x + 0.2, p.target.y + 0.2};
      }
    }
    return false;
  });
  CHECK(least >= -0.05);
  CHECK(clearance >= 0.22 - 0.05);
}

TEST_CASE("people between walls never pass through one") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  // two rooms with a door of 0.9 m between them; everybody wants into the other one
  const WalkingWorld world({10.0, 6.0}, {{{4.9, 0.0}, {5.1, 2.5}}, {{4.9, 3.4}, {5.1, 6.0}}});
  Walk walk(world, "dmrp.pedestrian." + model);
  for (uint64_t i = 0; i < 24; ++i) {
    const double x = 0.6 + 0.7 * static_cast<double>(i % 6);
    const double y = 0.9 + 1.4 * static_cast<double>(i / 6);
    walk.people.push_back(person(i + 1, {x, y}, {8.5, 6.0 - y}));
  }
  double clearance = 100.0;
  walk.until(20.0, [&] {
    for (const dmrp_person& p : walk.people) clearance = std::min(clearance, world.clearance(p.position));
    return false;
  });
  CHECK(clearance >= 0.25);
  const auto through =
      std::count_if(walk.people.begin(), walk.people.end(), [](const dmrp_person& p) { return p.position.x > 5.1; });
  CHECK(through >= 12);
}

TEST_CASE("people from both sides of a door all get through in the end") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const uint64_t seed = GENERATE(4u, 17u, 25u, 29u);  // in which ORCA's people blocked each other
  CAPTURE(model, seed);
  // the door is 1 m wide, 2.5 bodies
  const WalkingWorld world({12.0, 6.0}, {{{5.8, 0.0}, {6.2, 2.5}}, {{5.8, 3.5}, {6.2, 6.0}}});
  Walk walk(world, "dmrp.pedestrian." + model, {}, seed);
  dmrp::toolkit::Stream chance(seed, "door");
  for (uint64_t i = 0; i < 16; ++i) {
    const bool from_west = i % 2 == 0;
    const double x = 1.5 + 1.2 * static_cast<double>(i / 2 % 4);
    const double y = (i < 8 ? 1.5 : 3.5) + chance.uniform(0.0, 1.0);
    const double target_y = 0.6 + 0.68 * static_cast<double>(i / 2);  // all along the far wall
    walk.people.push_back(person(i + 1, {from_west ? x : 12.0 - x, y}, {from_west ? 11.4 : 0.6, target_y}));
    walk.people.back().radius_m = 0.2;
  }
  const auto is_through = [](const dmrp_person& p) {
    return p.target.x > 6.0 ? p.position.x > 6.4 : p.position.x < 5.6;
  };
  CHECK(walk.until(150.0, [&] { return std::all_of(walk.people.begin(), walk.people.end(), is_through); }));
}

}  // namespace all_models_test
