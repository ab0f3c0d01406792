// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

using namespace dmrp::test;
using dmrp::toolkit::distance;

namespace {

const std::string orca = "dmrp.pedestrian.orca";

}  // namespace

TEST_CASE("ORCA: somebody alone walks to the target at the desired speed and stops there") {
  const WalkingWorld world({44.0, 2.0}, {});
  Walk walk(world, orca);
  walk.people = {person(1, {1.0, 1.0}, {43.0, 1.0}, 1.33)};
  REQUIRE(walk.until(60.0, [&] { return walk.people[0].position.x >= 41.0; }));
  CHECK(walk.t_s() == Approx(40.0 / 1.33).margin(0.1));
  walk.until(3.0, [] { return false; });
  CHECK(distance(walk.people[0].position, walk.people[0].target) < 1e-3);
}

TEST_CASE("ORCA: two people pass each other head-on without touching") {
  const double width_m = GENERATE(2.0, 10.0);
  const double aside = GENERATE(0.0, 1e-6, 0.1, -0.3);
  const WalkingWorld world({24.0, width_m}, {});
  Walk walk(world, orca);
  const double y = 0.5 * width_m;
  walk.people = {person(1, {2.0, y}, {22.0, y}), person(2, {22.0, y + aside}, {2.0, y + aside})};
  double least = 100.0;
  REQUIRE(walk.until(20.0, [&] {
    least = std::min(least, least_gap(walk.people));
    return all_arrived(walk.people);
  }));
  CHECK(least >= 0.0);
}

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

TEST_CASE("ORCA: people walk round a box to a target behind it, in touch with it at most") {
  const WalkingWorld world({24.0, 10.0}, {{{10.0, 3.0}, {12.0, 7.0}}});
  const double y = GENERATE(5.0, 4.3, 6.9);
  Walk walk(world, orca);
  walk.people = {person(1, {2.0, y}, {22.0, 5.0})};
  double clearance = 100.0;
  REQUIRE(walk.until(22.0, [&] {
    clearance = std::min(clearance, world.clearance(walk.people[0].position));
    return arrived(walk.people[0]);
  }));
  CHECK(clearance >= 0.3 - 1e-6);
}

TEST_CASE("ORCA: robots are minded as much as the awareness says") {
  const dmrp_agent parked = robot(0, {12.0, 5.1});
  CHECK(passing_distance(orca, {{"robot_awareness", 1.0}}, parked) >= 0.55 - 1e-6);
  CHECK(passing_distance(orca, {{"robot_awareness", 0.5}}, parked) >= 0.55 - 0.001);
  CHECK(passing_distance(orca, {{"robot_awareness", 0.0}}, parked) < 0.55);  // stopped by the solid robot alone
  const dmrp_agent oncoming = robot(0, {22.0, 5.1}, {-0.5, 0.0});
  CHECK(passing_distance(orca, {{"robot_awareness", 1.0}}, oncoming) >= 0.55 - 1e-6);
}

TEST_CASE("ORCA: the less people are aware of robots, the later they turn aside") {
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

TEST_CASE("ORCA: who is blind to robots walks as though there were none") {
  const WalkingWorld world({24.0, 10.0}, {});
  Walk with(world, orca, {{"robot_awareness", 0.0}});
  Walk without(world, orca);
  with.people = without.people = {person(1, {2.0, 5.0}, {22.0, 5.0}), person(2, {8.0, 5.2}, {2.0, 5.0})};
  with.robots = {robot(0, {12.0, 7.0})};
  for (int i = 0; i < 400; ++i) {
    with.step();
    without.step();
    for (std::size_t p = 0; p < 2; ++p) CHECK(with.people[p].position == without.people[p].position);
  }
}

TEST_CASE("ORCA: a crowd never overlaps by 5 cm, crosses no wall and stays on the move") {
  const WalkingWorld world({12.0, 12.0},
                           {{{3.0, 3.0}, {4.0, 4.0}}, {{7.0, 2.0}, {8.0, 5.0}}, {{2.0, 8.0}, {8.0, 9.0}}});
  const uint64_t seed = GENERATE(1u, 2u);
  const uint64_t count = GENERATE(40u, 130u);  // 0.3 and 1 people/m2
  Walk walk(world, orca, {}, seed);
  walk.people = random_people(world, count, seed, 0.25);
  dmrp::toolkit::Stream chance(seed, "targets");
  double clearance = 100.0;
  double deepening = 0.0;  // of somebody in a wall, by the model's own velocities
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
  CHECK(clearance >= 0.25 - 0.01);  // what solid bodies take from a velocity may turn it toward a wall
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

TEST_CASE("ORCA: the same seed gives the same walk, whatever the instance did before") {
  const WalkingWorld world({20.0, 20.0}, {{{5.0, 5.0}, {7.0, 6.0}}});
  const WalkingWorld another({10.0, 10.0}, {});
  const auto where_they_end = [&](Walk& walk) {
    walk.people = random_people(world, 30, 3);
    walk.until(5.0, [] { return false; });
    return walk.people;
  };
  Walk first(world, orca, {}, 42);
  Walk second(world, orca, {}, 42);
  Walk of_another_seed(world, orca, {}, 43);
  second.restart(another, 1);
  second.people = {person(9, {1.0, 1.0}, {9.0, 9.0})};
  second.until(2.0, [] { return false; });
  second.restart(world, 42);

  const auto expected = where_they_end(first);
  const auto repeated = where_they_end(second);
  const auto differing = where_they_end(of_another_seed);
  int differ = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(expected[i].position == repeated[i].position);
    if (expected[i].position != differing[i].position) ++differ;
  }
  CHECK(differ > 15);  // some have arrived
}

TEST_CASE("ORCA: the slots that people stand in make no difference") {
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
