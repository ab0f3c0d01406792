// SPDX-License-Identifier: MIT
// A robot that waits for people and people whom it holds up do not wait for each other for ever.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

#include "tests/unit/pedestrians/walking_world.hpp"

namespace stand_off_test {

using namespace dmrp::test;

constexpr std::uint64_t starts = 20;

// A person who stands for at most `longest_stop_s` within 1.3 m of a robot.
struct Watch {
  double stopped_s = 0.0;
  double longest_stop_s = 0.0;

  void look(const dmrp_person& person, const dmrp_agent& robot) {
    const bool stands = dmrp::toolkit::norm(person.velocity) < 0.1 &&
                        dmrp::toolkit::distance(person.position, dmrp::toolkit::position(robot.pose)) < 1.3;
    stopped_s = stands ? stopped_s + Walk::step_s : 0.0;
    longest_stop_s = std::max(longest_stop_s, stopped_s);
  }
};

TEST_CASE("people pass a robot that stands in their way where there is room") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const double awareness = GENERATE(0.2, 1.0);
  const WalkingWorld world({24.0, 3.2}, {});
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    CAPTURE(model, awareness, seed);
    dmrp::toolkit::Stream random(seed, "stand_off_test");
    Walk walk(world, "dmrp.pedestrian." + model, {{"robot_awareness", awareness}}, seed);
    walk.people = {person(1, {2.0, 1.6 + random.uniform(-0.1, 0.1)}, {22.0, 1.6}, 1.13)};
    walk.robots = {robot(1, {12.0 + random.uniform(-0.1, 0.1), 1.6 + random.uniform(-0.1, 0.1)})};
    Watch watch;
    CHECK(walk.until(45.0, [&] {
      watch.look(walk.people[0], walk.robots[0]);
      return all_arrived(walk.people);
    }));
    CHECK(watch.longest_stop_s < 7.0);
  }
}

TEST_CASE("a person and a robot that waits for people both leave an aisle of 1.8 m") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const WalkingWorld world({24.0, 8.0}, {{{5.0, 0.0}, {19.0, 3.1}}, {{5.0, 4.9}, {19.0, 8.0}}});
  for (std::uint64_t seed = 1; seed <= starts; ++seed) {
    CAPTURE(model, seed);
    dmrp::toolkit::Stream random(seed, "stand_off_test");
    Walk walk(world, "dmrp.pedestrian." + model, {}, seed);
    walk.people = {person(1, {2.0, 4.0 + random.uniform(-0.1, 0.1)}, {22.0, 4.0}, 1.13)};
    walk.robots = {robot(1, {16.0 + random.uniform(-0.1, 0.1), 4.0 + random.uniform(-0.1, 0.1)})};
    Watch watch;
    dmrp_agent& robot = walk.robots[0];
    CHECK(walk.until(150.0, [&] {
      watch.look(walk.people[0], robot);
      const dmrp_vec2 apart = walk.people[0].position - dmrp::toolkit::position(robot.pose);
      const bool waits = apart.x < 0.0 && apart.x > -1.1 && std::abs(apart.y) < 0.6;
      robot.velocity = {waits || robot.pose.x < 2.0 ? 0.0 : -0.6, 0.0};
      return all_arrived(walk.people) && robot.pose.x < 2.0;
    }));
    CHECK(watch.longest_stop_s < 7.0);
  }
}

}  // namespace stand_off_test
