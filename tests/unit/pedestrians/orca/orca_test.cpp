// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

namespace orca_test {

using namespace dmrp::test;
using dmrp::toolkit::distance;

const std::string orca = "dmrp.pedestrian.orca";

TEST_CASE("ORCA: eight people on a circle change places") {
  const WalkingWorld world({20.0, 20.0}, {});
  const uint64_t seed = GENERATE(1u, 2u, 3u);
  Walk walk(world, orca, {}, seed);
  for (int i = 0; i < 8; ++i) {
    const dmrp_vec2 out = 6.0 * dmrp::toolkit::from_angle(i * 0.785398163397);
    walk.people.push_back(
        person(static_cast<uint64_t>(i + 1), dmrp_vec2{10.0, 10.0} + out, dmrp_vec2{10.0, 10.0} - out));
  }
  double least = 100.0;
  CHECK(walk.until(40.0, [&] {
    least = std::min(least, least_gap(walk.people));
    return all_arrived(walk.people);
  }));
  CHECK(least >= -0.001);
}

TEST_CASE("ORCA: people keep less distance from robots at a lower awareness") {
  const dmrp_agent parked = robot(0, {12.0, 5.1});
  CHECK(passing_distance(orca, {{"robot_awareness", 1.0}}, parked) >= 0.55 - 1e-6);
  CHECK(passing_distance(orca, {{"robot_awareness", 0.5}}, parked) >= 0.55 - 0.001);
  CHECK(passing_distance(orca, {{"robot_awareness", 0.0}}, parked) < 0.55);  // only the solid robot stops them
  const dmrp_agent oncoming = robot(0, {22.0, 5.1}, {-0.5, 0.0});
  CHECK(passing_distance(orca, {{"robot_awareness", 1.0}}, oncoming) >= 0.55 - 1e-6);
}

TEST_CASE("ORCA: people evade robots later at a lower awareness") {
  const auto turns_aside_at = [](double awareness) {
    const WalkingWorld world({24.0, 10.0}, {});
    Walk walk(world, orca, {{"robot_awareness", awareness}});
    walk.people = {person(1, {2.0, 5.0}, {22.0, 5.0})};
    walk.robots = {robot(0, {12.0, 5.1})};
    REQUIRE(walk.until(20.0, [&] { return std::abs(walk.people[0].position.y - 5.0) > 0.05; }));
    return walk.people[0].position.x;
  };
  CHECK(turns_aside_at(1.0) < turns_aside_at(0.5) - 0.5);
  CHECK(turns_aside_at(0.5) < turns_aside_at(0.25) - 0.3);
}

TEST_CASE("ORCA: people in a crowd never overlap by 5 cm, cross no wall and keep moving") {
  const WalkingWorld world({12.0, 12.0},
                           {{{3.0, 3.0}, {4.0, 4.0}}, {{7.0, 2.0}, {8.0, 5.0}}, {{2.0, 8.0}, {8.0, 9.0}}});
  const uint64_t seed = GENERATE(1u, 2u);
  const uint64_t count = GENERATE(40u, 130u);  // 0.3 and 1 people/m2
  Walk walk(world, orca, {}, seed);
  walk.people = random_people(world, count, seed, 0.25);
  dmrp::toolkit::Stream chance(seed, "targets");
  double clearance = 100.0;
  double deepening = 0.0;  // of an overlap with a wall, by the model's own velocities
  double least = 100.0;
  int arrivals = 0;
  std::vector<dmrp_person> before = walk.people;
  walk.until(20.0, [&] {
    for (std::size_t i = 0; i < before.size(); ++i) {
      const dmrp_vec2 next = before[i].position + Walk::step_s * walk.velocities[i];
      const double allowed = std::min(before[i].radius_m, world.clearance(before[i].position));
      deepening = std::max(deepening, allowed - world.clearance(next));
    }
    before = walk.people;
    least = std::min(least, least_gap(walk.people));
    for (dmrp_person& p : walk.people) {
      clearance = std::min(clearance, world.clearance(p.position));
      if (distance(p.position, p.target) > 1.0) continue;
      ++arrivals;
      const dmrp_person other = walk.people[chance.below(walk.people.size())];
      p.target = other.target;
      p.target_id = other.target_id;
      p.area_lower = other.area_lower;
      p.area_upper = other.area_upper;
    }
    return false;
  });
  CHECK(deepening < 1e-6);
  CHECK(clearance >= 0.25 - 0.01);  // contacts may turn a velocity toward a wall
  CHECK(least >= -0.05);
  CHECK(arrivals > 20);
}

TEST_CASE("ORCA: packed at just below 4 people/m2 nobody overlaps by 5 cm") {
  const WalkingWorld world({5.0, 5.0}, {});
  Walk walk(world, orca);
  dmrp::toolkit::Stream chance(5, "targets");
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 11; ++column) {
      const dmrp_vec2 at = {0.3 + 0.44 * column, 0.3 + 0.52 * row};
      walk.people.push_back(person(walk.people.size() + 1, at, anywhere(world, chance)));
      walk.people.back().radius_m = 0.22;
    }
  double least = 100.0;
  double clearance = 100.0;
  walk.until(10.0, [&] {
    least = std::min(least, least_gap(walk.people));
    for (const dmrp_person& p : walk.people) clearance = std::min(clearance, world.clearance(p.position));
    return false;
  });
  CHECK(least >= -0.05);
  CHECK(clearance >= 0.22 - 0.02);
}

TEST_CASE("ORCA: velocities do not depend on the slots of people") {
  const WalkingWorld world({20.0, 20.0}, {});
  Walk one(world, orca);
  // on a lattice: most neighbours are at the same distance as another
  dmrp::toolkit::Stream chance(6, "targets");
  for (int i = 0; i < 81; ++i)
    one.people.push_back(
        person(static_cast<uint64_t>(i + 1), {4.0 + i % 9, 4.0 + i / 9}, anywhere(world, chance)));  // NOLINT
  Walk other(world, orca);
  other.people = one.people;
  std::reverse(other.people.begin(), other.people.end());
  for (int step = 0; step < 50; ++step) {
    one.step();
    other.step();
  }
  for (std::size_t i = 0; i < 81; ++i) CHECK(one.velocities[i] == other.velocities[80 - i]);
}

}  // namespace orca_test
