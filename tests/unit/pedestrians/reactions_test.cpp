// SPDX-License-Identifier: MIT
// What people do when they see a robot: HuNavSim's behaviours in all models.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <map>

#include "pedestrians/crowd/robot_reactions.hpp"
#include "tests/unit/pedestrians/walking_world.hpp"

namespace reactions_test {

using namespace dmrp::test;

const WalkingWorld& hall() {
  static const WalkingWorld world({24.0, 16.0}, {});
  return world;
}

// A person who walks 20 m east past a robot that stands 3 m beside the way, and how it goes.
struct Encounter {
  Encounter(const std::string& model, std::uint32_t reaction, ParamOverrides params = {}, std::uint64_t seed = 1)
      : walk(hall(), "dmrp.pedestrian." + model, std::move(params), seed) {
    walk.people = {person(1, {2.0, 6.0}, {22.0, 6.0}, 1.2)};
    walk.people[0].reaction = reaction;
    walk.robots = {robot(1, {12.0, 9.0})};
    arrives = walk.until(60.0, [this] {
      look();
      return all_arrived(walk.people);
    });
  }

  void look() {
    const dmrp_vec2 at = walk.people[0].position;
    nearest_m = std::min(nearest_m, dmrp::toolkit::distance(at, {12.0, 9.0}));
    to_front_m = std::min(to_front_m, dmrp::toolkit::distance(at, {12.95, 9.0}));
    stands_s += dmrp::toolkit::norm(walk.people[0].velocity) < 0.05 ? Walk::step_s : 0.0;
    places.push_back(at);
  }

  Walk walk;
  bool arrives = false;
  double nearest_m = 100.0;
  double to_front_m = 100.0;  // to a place before the robot
  double stands_s = 0.0;
  std::vector<dmrp_vec2> places;
};

TEST_CASE("people answer to a robot as their reaction says, and walk on") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  const Encounter unspecified(model, DMRP_REACTION_UNSPECIFIED);
  CHECK(unspecified.arrives);
  CHECK(unspecified.nearest_m > 2.0);
  CHECK(unspecified.stands_s < 0.5);

  const Encounter surprised(model, DMRP_REACTION_SURPRISED);
  CHECK(surprised.arrives);
  CHECK(surprised.stands_s > 2.0);
  CHECK(surprised.stands_s < 8.0);

  const Encounter curious(model, DMRP_REACTION_CURIOUS);
  CHECK(curious.arrives);
  CHECK(curious.nearest_m < 1.6);

  const Encounter scared(model, DMRP_REACTION_SCARED);
  CHECK(scared.arrives);
  CHECK(scared.nearest_m > unspecified.nearest_m + 0.5);  // makes a detour

  const Encounter threatening(model, DMRP_REACTION_THREATENING);
  CHECK(threatening.arrives);
  CHECK(threatening.to_front_m < 0.3);

  const Encounter another_seed(model, DMRP_REACTION_SURPRISED, {}, 2);
  CHECK(another_seed.stands_s != surprised.stands_s);
}

TEST_CASE("whatever their reactions, people pass a robot that stands in a corridor") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const WalkingWorld corridor({24.0, 3.2}, {});
  for (std::uint32_t reaction = DMRP_REACTION_REGULAR; reaction <= DMRP_REACTION_THREATENING; ++reaction) {
    CAPTURE(model, reaction);
    Walk walk(corridor, "dmrp.pedestrian." + model);
    walk.people = {person(1, {2.0, 1.6}, {22.0, 1.6}, 1.2)};
    walk.people[0].reaction = reaction;
    walk.robots = {robot(1, {12.0, 1.65})};
    CHECK((reaction == DMRP_REACTION_IMPASSIVE || walk.until(90.0, [&] { return all_arrived(walk.people); })));
  }
}

TEST_CASE("regular and impassive people do not depend on robot_awareness") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  const auto places = [&](std::uint32_t reaction, double awareness) {
    return Encounter(model, reaction, {{"robot_awareness", awareness}}).places;
  };
  CHECK(places(DMRP_REACTION_REGULAR, 0.0) == places(DMRP_REACTION_UNSPECIFIED, 1.0));
  CHECK(places(DMRP_REACTION_IMPASSIVE, 1.0) == places(DMRP_REACTION_UNSPECIFIED, 0.0));
}

TEST_CASE("shares of the people have reactions, drawn from the seed") {
  using dmrp::pedestrians::RobotReactions;
  RobotReactions reactions, again;
  reactions.start(3, dmrp::toolkit::GridView(hall().walking_grid()), {0.1, 0.2, 0.3, 0.0});
  again.start(3, dmrp::toolkit::GridView(hall().walking_grid()), {0.1, 0.2, 0.3, 0.0});
  std::map<std::uint32_t, int> counts;
  for (std::uint64_t id = 0; id < 10000; ++id) {
    const dmrp_person someone = person(id, {1.0, 1.0}, {2.0, 1.0});
    CHECK(reactions.of(someone) == again.of(someone));
    ++counts[reactions.of(someone)];
  }
  CHECK(counts[DMRP_REACTION_SURPRISED] == Approx(1000).margin(150));
  CHECK(counts[DMRP_REACTION_CURIOUS] == Approx(2000).margin(200));
  CHECK(counts[DMRP_REACTION_SCARED] == Approx(3000).margin(200));
  CHECK(counts[DMRP_REACTION_UNSPECIFIED] == Approx(4000).margin(200));
  dmrp_person own = person(1, {1.0, 1.0}, {2.0, 1.0});
  own.reaction = DMRP_REACTION_CURIOUS;  // the person's own comes first
  CHECK(reactions.of(own) == DMRP_REACTION_CURIOUS);
  own.reaction = 99;  // of a later version
  CHECK(reactions.of(own) == reactions.of(person(1, {1.0, 1.0}, {2.0, 1.0})));

  Encounter curious("orca", DMRP_REACTION_UNSPECIFIED, {{"curious_share", 1.0}});
  CHECK(curious.nearest_m < 1.6);
  CHECK_THROWS(reactions.start(3, dmrp::toolkit::GridView(hall().walking_grid()), {0.5, 0.5, 0.5, 0.0}));
}

}  // namespace reactions_test
