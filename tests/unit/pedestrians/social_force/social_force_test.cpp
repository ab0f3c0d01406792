// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "pedestrians/social_force/headway.hpp"
#include "tests/unit/pedestrians/walking_world.hpp"

namespace social_force_test {

using namespace dmrp::test;
using dmrp::toolkit::distance;

const std::string social_force = "dmrp.pedestrian.social_force";

TEST_CASE("social force: a lone person reaches the desired speed with the time constant relaxation time / weight") {
  const WalkingWorld world({40.0, 20.0}, {});
  Walk walk(world, social_force);
  walk.people = {person(1, {10.0, 10.0}, {35.0, 10.0}, 1.3)};
  walk_for(walk, 0.25);  // 0.5 s by weight 2
  CHECK(walk.people[0].velocity.x == Approx(1.3 * (1.0 - std::exp(-1.0))).margin(0.05));
  walk_for(walk, 5.0);
  CHECK(walk.people[0].velocity.x == Approx(1.3).margin(1e-3));
  CHECK(walk.people[0].velocity.y == Approx(0.0).margin(1e-9));
}

TEST_CASE("social force: the headway is the distance to contact straight ahead, of bodies that do not approach") {
  using dmrp::pedestrians::headway;
  const dmrp_vec2 east = {1.0, 0.0};
  CHECK(headway(east, {3.0, 0.0}, 0.5, {0.0, 0.0}) == Approx(2.5));
  CHECK(headway(east, {3.0, 0.3}, 0.5, {1.0, 0.0}) == Approx(2.6));  // 3 - sqrt(0.5^2 - 0.3^2)
  CHECK(headway({0.6, 0.8}, {1.8, 2.4}, 0.5, {0.0, 0.0}) == Approx(2.5));
  CHECK(headway(east, {0.3, 0.1}, 0.5, {0.0, 0.0}) == 0.0);  // touches already
  CHECK(std::isinf(headway(east, {3.0, -0.5}, 0.5, {0.0, 0.0})));
  CHECK(std::isinf(headway(east, {-3.0, 0.0}, 0.5, {0.0, 0.0})));
  CHECK(std::isinf(headway(east, {3.0, 0.0}, 0.5, {-1.0, 0.0})));
}

TEST_CASE("social force: a person behind a slower one keeps the time gap") {
  const WalkingWorld world({60.0, 0.8}, {});
  Walk walk(world, social_force);
  walk.people = {person(1, {2.0, 0.4}, {55.0, 0.4}, 1.5), person(2, {5.0, 0.4}, {55.0, 0.4}, 0.6)};
  walk_for(walk, 30.0);
  // the person behind speeds the slower one up a little
  const double speed = walk.people[0].velocity.x;
  CHECK(speed == Approx(walk.people[1].velocity.x).margin(0.01));
  CHECK(speed <= 1.3 * 0.6);
  const double gap_m = distance(walk.people[0].position, walk.people[1].position) - 0.6;
  CHECK(gap_m >= 0.5 * speed);  // s * m/s
  CHECK(gap_m <= 1.0);
}

TEST_CASE("social force: RiMEA 1: 40 m of a 2 m corridor at 1.33 m/s take 26 to 34 s") {
  const WalkingWorld world({44.0, 2.0}, {});
  Walk walk(world, social_force);
  walk.people = {person(1, {1.0, 1.0}, {43.0, 1.0}, 1.33)};
  REQUIRE(walk.until(60.0, [&] { return walk.people[0].position.x >= 41.0; }));
  CHECK(walk.t_s() >= 26.0);
  CHECK(walk.t_s() <= 34.0);
}

TEST_CASE("social force: people in an exactly head-on encounter turn right") {
  const WalkingWorld world({24.0, 10.0}, {});
  Walk walk(world, social_force);
  walk.people = {person(1, {8.0, 5.0}, {20.0, 5.0}), person(2, {12.0, 5.0}, {4.0, 5.0})};
  walk_for(walk, 1.2);
  CHECK(walk.people[0].position.y < 5.0);
  CHECK(walk.people[1].position.y > 5.0);
}

TEST_CASE("social force: people keep a distance from a wall that they walk along or toward") {
  const WalkingWorld world({40.0, 10.0}, {});
  Walk walk(world, social_force);
  const dmrp_vec2 target = GENERATE(dmrp_vec2{35.0, 0.31}, dmrp_vec2{5.0, 0.31});
  walk.people = {person(1, {5.0, 3.0}, target)};
  double clearance = 100.0;
  walk.until(25.0, [&] {
    clearance = std::min(clearance, world.clearance(walk.people[0].position));
    return false;
  });
  CHECK(clearance >= 0.3);
  CHECK(distance(walk.people[0].position, target) < 1.0);
}

TEST_CASE("social force: a wall in two pieces pushes like one piece") {
  const WalkingWorld whole({20.0, 10.0}, {{{0.0, 4.0}, {20.0, 5.0}}});
  const WalkingWorld pieces({20.0, 10.0}, {{{0.0, 4.0}, {10.0, 5.0}}, {{10.0, 4.0}, {20.0, 5.0}}});
  Walk beside_whole(whole, social_force);
  Walk beside_pieces(pieces, social_force);
  for (Walk* walk : {&beside_whole, &beside_pieces}) {
    walk->people = {person(1, {10.0, 3.4}, {10.0, 3.4}), person(2, {15.0, 3.4}, {15.0, 3.4})};
    walk->step();
  }
  CHECK(beside_whole.velocities[0].y < -0.01);
  CHECK(beside_pieces.velocities[0].y == Approx(beside_whole.velocities[0].y).epsilon(1e-9));
  CHECK(beside_pieces.velocities[1].y == Approx(beside_whole.velocities[1].y).epsilon(1e-9));
}

TEST_CASE("social force: people keep less distance from robots at a lower awareness") {
  const dmrp_agent parked = robot(0, {12.0, 5.1});
  const double aware = passing_distance(social_force, {}, parked);
  const double half_aware = passing_distance(social_force, {{"robot_awareness", 0.5}}, parked);
  const double unaware = passing_distance(social_force, {{"robot_awareness", 0.0}}, parked);
  CHECK(aware >= 0.6);  // the bodies touch at 0.55 m
  CHECK(half_aware < aware);
  CHECK(unaware < 0.552);  // only the solid robot stops them
  CHECK(passing_distance(social_force, {}, robot(0, {12.0, 5.1}, {0.0, 0.0}, 0.5)) >= aware + 0.2);
}

TEST_CASE("social force: eight people pass a 1.2 m door in both directions") {
  const WalkingWorld world({16.0, 10.0}, {{{7.9, 0.0}, {8.1, 4.4}}, {{7.9, 5.6}, {8.1, 10.0}}});
  Walk walk(world, social_force);
  for (uint64_t i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const double y = 2.0 + static_cast<double>(i) * 0.8;
    walk.people.push_back(person(i + 1, {8.0 - side * 4.0, y}, {8.0 + side * 6.0, y}));
  }
  CHECK(walk.until(60.0, [&] { return all_arrived(walk.people); }));
}

TEST_CASE("social force: RiMEA 6: twenty people around a corner stay in the free space") {
  // a corridor of 2 m width, 10 m east, then 10 m north
  const WalkingWorld world({12.0, 12.0}, {{{0.0, 2.0}, {10.0, 12.0}}});
  Walk walk(world, social_force);
  for (uint64_t i = 0; i < 20; ++i) {
    const uint64_t rank = i / 2;
    const dmrp_vec2 at = {0.6 + 0.7 * static_cast<double>(rank), i % 2 == 0 ? 0.6 : 1.4};
    walk.people.push_back(person(i + 1, at, {11.0, 11.5}, 1.2));
    walk.people.back().target_id = 1;
    walk.people.back().area_lower = {10.0, 11.0};
    walk.people.back().area_upper = {12.0, 12.0};
  }
  double clearance = 100.0;
  const bool all_round = walk.until(60.0, [&] {
    for (const dmrp_person& p : walk.people) clearance = std::min(clearance, world.clearance(p.position));
    return std::all_of(walk.people.begin(), walk.people.end(), [](const dmrp_person& p) { return p.position.y > 6.0; });
  });
  CHECK(clearance >= 0.25);
  // people who arrived block the far end for the others, so passing the corner is enough
  CHECK(all_round);
}

TEST_CASE("social force: a hundred people stay in the free space and keep moving for a minute") {
  const WalkingWorld world({20.0, 20.0},
                           {{{5.0, 5.0}, {7.0, 6.0}}, {{12.0, 3.0}, {13.0, 9.0}}, {{4.0, 12.0}, {15.0, 13.0}}});
  Walk walk(world, social_force);
  walk.people = random_people(world, 100, 7);
  dmrp::toolkit::Stream chance(7, "targets");
  double clearance = 100.0;
  int arrivals = 0;
  walk.until(60.0, [&] {
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
  CHECK(clearance >= 0.25);
  CHECK(arrivals > 150);
}

TEST_CASE("social force: velocities do not depend on the order of people far away") {
  const WalkingWorld world({60.0, 20.0}, {});
  Walk one(world, social_force);
  one.people = random_people(world, 40, 11);
  Walk other(world, social_force);
  other.people = one.people;
  // people beyond the reach of those at the west end swap slots in pairs
  std::vector<std::size_t> far;
  for (std::size_t i = 0; i < one.people.size(); ++i)
    if (one.people[i].position.x > 20.0) far.push_back(i);
  for (std::size_t i = 0; i + 1 < far.size(); i += 2) std::swap(other.people[far[i]], other.people[far[i + 1]]);
  one.step();
  other.step();
  int compared = 0;
  for (std::size_t i = 0; i < one.people.size(); ++i) {
    if (one.people[i].position.x > 14.0) continue;
    CHECK(one.velocities[i] == other.velocities[i]);
    ++compared;
  }
  CHECK(compared >= 3);
}

TEST_CASE("social force: a new person in a slot gets a new way") {
  const WalkingWorld world({24.0, 10.0}, {{{10.0, 3.0}, {12.0, 7.0}}});
  const dmrp_person newcomer = person(2, {9.0, 5.0}, {2.0, 5.0});
  Walk fresh(world, social_force);
  fresh.people = {newcomer};
  Walk taken_over(world, social_force);
  taken_over.people = {person(1, {9.0, 5.0}, {22.0, 5.0})};
  taken_over.step();
  taken_over.people = {newcomer};
  fresh.step();
  taken_over.step();
  CHECK(fresh.velocities[0] == taken_over.velocities[0]);
}

TEST_CASE("social force: a group stays together where strangers separate") {
  const WalkingWorld world({50.0, 10.0}, {});
  const auto distance_after_walk = [&](uint32_t group) {
    Walk walk(world, social_force);
    walk.people = {person(1, {3.0, 4.5}, {48.0, 5.0}, 1.4), person(2, {3.0, 5.5}, {48.0, 5.0}, 1.1)};
    for (dmrp_person& p : walk.people) p.group = group;
    walk_for(walk, 20.0);
    CHECK(walk.people[1].position.x > 20.0);
    return distance(walk.people[0].position, walk.people[1].position);
  };
  CHECK(distance_after_walk(0) > 4.0);
  CHECK(distance_after_walk(1) < 2.0);
  CHECK(distance_after_walk(1) > 0.6);
}

}  // namespace social_force_test
