// SPDX-License-Identifier: MIT
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "pedestrians/collision_free_speed/speed_function.hpp"
#include "tests/unit/pedestrians/walking_world.hpp"

namespace collision_free_speed_test {

using namespace dmrp::test;
using dmrp::toolkit::distance;

const std::string cfs = "dmrp.pedestrian.collision_free_speed";

TEST_CASE("CFS: the speed is the gap over the time gap, between 0 and the desired speed") {
  using dmrp::pedestrians::permitted_speed;
  CHECK(permitted_speed(1.2, 0.6, 1.0) == Approx(0.6));
  CHECK(permitted_speed(1.2, 0.6, 0.5) == Approx(1.2));
  CHECK(permitted_speed(1.2, 0.3, 0.5) == Approx(0.6));
  CHECK(permitted_speed(1.2, 5.0, 1.0) == 1.2);
  CHECK(permitted_speed(1.2, -0.01, 1.0) == 0.0);
}

TEST_CASE("CFS: bodies in the strip ahead are in the way") {
  using dmrp::pedestrians::is_in_the_way;
  const dmrp_vec2 east = {1.0, 0.0};
  CHECK(is_in_the_way(east, {2.0, 0.39}, 0.4));
  CHECK(is_in_the_way(east, {2.0, -0.39}, 0.4));
  CHECK_FALSE(is_in_the_way(east, {2.0, 0.41}, 0.4));
  CHECK_FALSE(is_in_the_way(east, {-1.0, 0.0}, 0.4));
  CHECK(is_in_the_way({0.6, 0.8}, {1.2, 1.6}, 0.1));
}

TEST_CASE("CFS: the repulsion falls with the gap and does not grow in an overlap") {
  using dmrp::pedestrians::repulsion;
  CHECK(repulsion(8.0, 0.1, 0.0) == 8.0);
  CHECK(repulsion(8.0, 0.1, 0.1) == Approx(8.0 * std::exp(-1.0)));
  CHECK(repulsion(8.0, 0.1, -0.2) == 8.0);
}

TEST_CASE("CFS: one step behind, beside and in front of a person, computed by hand") {
  const WalkingWorld world({40.0, 20.0}, {});
  const auto first_velocity = [&](dmrp_vec2 other, ParamOverrides params) {
    Walk walk(world, cfs, std::move(params));
    walk.people = {person(1, {10.0, 10.0}, {35.0, 10.0}, 1.3), person(2, other, other)};
    walk.step();
    return walk.velocities[0];
  };
  // a gap of 0.5 m and 1 s
  const dmrp_vec2 behind = first_velocity({11.1, 10.0}, {{"time_gap", 1.0}});
  CHECK(behind.x == Approx(0.5).epsilon(1e-5));
  CHECK(std::abs(behind.y) <= 0.5e-3 * 1.1);  // side preference
  // 1 cm outside the strip: nobody is in the way, but the repulsion 8 exp(-(s - 0.6) / 0.1) acts along (-1, -0.61) / s
  const double s = std::hypot(1.0, 0.61);
  const double away = 8.0 * std::exp(-(s - 0.6) / 0.1) / s;
  const dmrp_vec2 beside = first_velocity({11.0, 10.61}, {});
  CHECK(dmrp::toolkit::norm(beside) == Approx(1.3).epsilon(1e-9));
  CHECK(beside.y / beside.x == Approx(-0.61 * away / (1.0 - away)).margin(1.1e-3));
  // a person behind
  CHECK(first_velocity({8.9, 10.0}, {}).x == Approx(1.3).epsilon(1e-5));
}

TEST_CASE("CFS: a person behind a slower one keeps the time gap and never overlaps") {
  const WalkingWorld world({60.0, 0.8}, {});
  const double time_gap_s = GENERATE(0.5, 1.0);
  Walk walk(world, cfs, {{"time_gap", time_gap_s}});
  walk.people = {person(1, {2.0, 0.4}, {55.0, 0.4}, 1.5), person(2, {5.0, 0.4}, {55.0, 0.4}, 0.6)};
  double least = 100.0;
  walk.until(20.0, [&] {
    least = std::min(least, least_gap(walk.people));
    return false;
  });
  CHECK(least > 0.0);
  CHECK(walk.people[0].velocity.x == Approx(0.6).margin(0.01));
  CHECK(least_gap(walk.people) == Approx(0.6 * time_gap_s).margin(0.02));
}

TEST_CASE("CFS: nobody walks into a wall, at any speed and for any target behind it") {
  const WalkingWorld world({20.0, 10.0}, {{{10.0, 0.0}, {10.2, 10.0}}});
  const double y = GENERATE(0.4, 5.0, 9.6);  // toward the wall's middle, and into its corners
  Walk walk(world, cfs);
  walk.people = {person(1, {7.0, 5.0}, {18.0, y}, 4.0)};
  double clearance = 100.0;
  walk.until(10.0, [&] {
    clearance = std::min(clearance, world.clearance(walk.people[0].position));
    return false;
  });
  CHECK(clearance >= 0.3 - 1e-6);
  CHECK(walk.people[0].position.x < 9.8);
}

TEST_CASE("CFS: people keep less distance from robots at a lower awareness") {
  const dmrp_agent parked = robot(0, {12.0, 5.1});
  const double aware = passing_distance(cfs, {{"robot_awareness", 1.0}}, parked);
  const double half_aware = passing_distance(cfs, {{"robot_awareness", 0.5}}, parked);
  CHECK(aware >= 0.55);
  CHECK(half_aware >= 0.55);
  CHECK(half_aware < aware);
  CHECK(passing_distance(cfs, {{"robot_awareness", 0.0}}, parked) < 0.55);  // only the solid robot stops them
}

TEST_CASE("CFS: the time gap to a robot is proportional to the awareness") {
  const WalkingWorld world({60.0, 0.8}, {});
  const double awareness = GENERATE(1.0, 0.5, 0.25);
  Walk walk(world, cfs, {{"robot_awareness", awareness}, {"time_gap", 1.0}});
  walk.people = {person(1, {2.0, 0.4}, {55.0, 0.4}, 1.5)};
  walk.robots = {robot(0, {5.0, 0.4}, {0.6, 0.0})};
  walk_for(walk, 20.0);
  CHECK(walk.people[0].velocity.x == Approx(0.6).margin(0.01));
  const double gap_m = walk.robots[0].pose.x - walk.people[0].position.x - 0.55;
  CHECK(gap_m == Approx(0.6 * awareness).margin(0.02));
}

TEST_CASE("CFS: two people who block each other at a door get through") {
  // each stands in the other's way, as two of the 1,000 people did at the end of RiMEA's test 9
  const WalkingWorld world({10.0, 6.0}, {{{0.0, 2.0}, {4.0, 3.0}}, {{5.0, 2.0}, {10.0, 3.0}}});
  Walk walk(world, cfs);
  walk.people = {person(1, {4.205, 3.236}, {4.508, 2.044}), person(2, {4.820, 3.236}, {4.303, 2.167})};
  for (dmrp_person& each : walk.people) each.radius_m = 0.2;
  const auto is_through = [&] { return walk.people[0].position.y < 2.6 && walk.people[1].position.y < 2.6; };
  CHECK(walk.until(20.0, is_through));
}

}  // namespace collision_free_speed_test
