// SPDX-License-Identifier: MIT
// People who answer to robots in ways of their own.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/contract_wishes/driver.hpp"

using namespace dmrp::test;

namespace {

// The velocity of a person at the origin who walks along +x at 1 m/s, with a robot 2 m ahead.
dmrp_vec2 velocity(const Instance& model, std::uint32_t reaction, double robot_x = 2.0) {
  std::vector<Longer<dmrp_person>> people(2);
  for (auto& person : people) {
    person.known.desired_speed = 1.0;
    person.known.target = {10.0, 0.0};
  }
  people[0].known.position = {0.0, 50.0};  // another one, far away
  people[1].known.reaction = reaction;
  std::vector<Longer<dmrp_agent>> robots(1);
  robots[0].known.kind = DMRP_AGENT_ROBOT;
  robots[0].known.pose.x = robot_x;
  dmrp_crowd crowd{};
  crowd.struct_size = sizeof(crowd);
  crowd.people = &people.front().known;
  crowd.person_count = 2;
  crowd.person_stride = sizeof(people.front());
  crowd.robots = &robots.front().known;
  crowd.robot_count = 1;
  crowd.robot_stride = sizeof(robots.front());
  std::vector<Longer<dmrp_motion>> motions(2);
  dmrp_motions out = {sizeof(out), 2, sizeof(motions.front()), 0, &motions.front().known};
  REQUIRE(model.as<dmrp_pedestrian_model>().step(model.c.self, &crowd, &out) == DMRP_OK);
  for (const auto& motion : motions) CHECK(motion.unknown == 0x5555555555555555u);
  return motions[1].known.velocity;
}

bool equal(dmrp_vec2 a, dmrp_vec2 b) {
  return a.x == b.x && a.y == b.y;
}

}  // namespace

TEST_CASE("people answer to a robot as their reaction says") {
  Library library(REACTIONS);
  Instance model(library);
  World world({"..", ".."}, 1);
  REQUIRE(model.start(world) == DMRP_OK);

  CHECK(equal(velocity(model, DMRP_REACTION_IMPASSIVE), {1.0, 0.0}));
  CHECK(equal(velocity(model, DMRP_REACTION_SURPRISED), {0.0, 0.0}));
  CHECK(equal(velocity(model, DMRP_REACTION_CURIOUS), {1.0, 0.0}));
  CHECK(equal(velocity(model, DMRP_REACTION_SCARED), {-1.0, 0.0}));
  const dmrp_vec2 regular = velocity(model, DMRP_REACTION_REGULAR);
  CHECK(regular.y != 0.0);
  CHECK(std::hypot(regular.x, regular.y) == Approx(1.0));

  // a robot that is far away changes nothing
  for (std::uint32_t reaction = 0; reaction < 10; ++reaction) CHECK(equal(velocity(model, reaction, 9.0), {1.0, 0.0}));
}

TEST_CASE("a model takes a reaction that it does not know for an unspecified one") {
  Library library(REACTIONS);
  Instance model(library);
  World world({"..", ".."}, 1);
  REQUIRE(model.start(world) == DMRP_OK);
  const dmrp_vec2 unspecified = velocity(model, DMRP_REACTION_UNSPECIFIED);
  CHECK(equal(unspecified, velocity(model, DMRP_REACTION_REGULAR)));  // by the parameter's default
  for (const std::uint32_t unknown : {7u, 1000u, 0xFFFFFFFFu}) CHECK(equal(velocity(model, unknown), unspecified));
}
