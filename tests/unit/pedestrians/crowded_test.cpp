// SPDX-License-Identifier: MIT
// What all models promise in a crowd.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

using namespace dmrp::test;

namespace {

// On a lattice between the walls, as dense as asked for, each bound for somewhere else.
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

}  // namespace

TEST_CASE("below 4 people per square metre nobody overlaps by 5 cm, nor gets into a wall") {
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

TEST_CASE("people with walls on all sides of their way never get through one") {
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
