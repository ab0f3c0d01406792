// SPDX-License-Identifier: MIT
// What people do when they see a robot: HuNavSim's behaviours in all models.
#include "pedestrians/crowd/reactions.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <map>

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

TEST_CASE("off, people answer to a robot no more than the model has it") {
  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  CAPTURE(model);
  // a person and a waiting robot in an aisle too narrow to pass
  const WalkingWorld aisle({24.0, 1.0}, {});
  const auto steps_back = [&](const char* reactions) {
    Walk walk(aisle, "dmrp.pedestrian." + model, {{"reactions", reactions}});
    walk.people = {person(1, {2.0, 0.5}, {22.0, 0.5}, 1.2)};
    walk.robots = {robot(1, {6.0, 0.5})};
    double furthest_m = 0.0, back_m = 0.0;
    walk.until(20.0, [&] {
      furthest_m = std::max(furthest_m, walk.people[0].position.x);
      back_m = std::max(back_m, furthest_m - walk.people[0].position.x);
      return false;
    });
    return back_m > 0.5;
  };
  CHECK(steps_back("on"));
  CHECK_FALSE(steps_back("off"));
  // regular and impassive people only have an awareness of their own
  const auto places = [&](std::uint32_t reaction, double awareness) {
    return Encounter(model, reaction, {{"robot_awareness", awareness}, {"reactions", "off"}}).places;
  };
  CHECK(places(DMRP_REACTION_REGULAR, 0.0) == places(DMRP_REACTION_UNSPECIFIED, 1.0));
  CHECK(places(DMRP_REACTION_IMPASSIVE, 1.0) == places(DMRP_REACTION_UNSPECIFIED, 0.0));
}

TEST_CASE("off, nobody has the right of way") {
  using namespace dmrp::pedestrians;
  std::vector<dmrp_person> people = {person(1, {4.0, 2.0}, {9.0, 2.0}), person(2, {5.0, 2.0}, {1.0, 2.0})};
  const auto somebody_ignores = [&](bool is_on) {
    Reactions reactions;
    reactions.start(1, dmrp::toolkit::GridView(hall().walking_grid()), is_on, 1.0, {});
    for (int step = 0; step < 1000; ++step) {
      reactions.begin_step();
      reactions.wish(people[0], {1.0, 0.0}, {}, Walk::step_s);
      reactions.wish(people[1], {-1.0, 0.0}, {}, Walk::step_s);
    }
    const auto ignores = [&](std::uint32_t slot, std::uint32_t other) {
      return reactions.ignores(slot, {people[other].position, {0.0, 0.0}, 0.3, other}, {people.data(), people.size()});
    };
    return ignores(0, 1) || ignores(1, 0);
  };
  CHECK(somebody_ignores(true));
  CHECK_FALSE(somebody_ignores(false));
}

TEST_CASE("off, shares are refused, and a model says that it leaves out a flow's reaction") {
  dmrp::pedestrians::Reactions reactions;
  const dmrp::toolkit::GridView grid(hall().walking_grid());
  CHECK_THROWS_WITH(reactions.start(1, grid, false, 1.0, {0.0, 0.0, 0.1, 0.0}), Catch::Contains("reactions = \"on\""));

  const std::string model = GENERATE("social_force", "orca", "collision_free_speed");
  const auto warnings = [&](std::uint32_t reaction, const char* setting) {
    Walk walk(hall(), "dmrp.pedestrian." + model, {{"reactions", setting}});
    walk.people = {person(1, {2.0, 6.0}, {22.0, 6.0})};
    walk.people[0].reaction = reaction;
    walk_for(walk, 0.1);
    return walk.log().size();
  };
  CHECK(warnings(DMRP_REACTION_CURIOUS, "off") == 1);
  CHECK(warnings(DMRP_REACTION_CURIOUS, "on") == 0);
  CHECK(warnings(DMRP_REACTION_IMPASSIVE, "off") == 0);
}

}  // namespace reactions_test
