// SPDX-License-Identifier: MIT
// The people of one step, sorted by their places in the neighbour grid.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/right_of_way.hpp"
#include "pedestrians/crowd/robot_reactions.hpp"
#include "pedestrians/crowd/ways_past_robots.hpp"

namespace dmrp::pedestrians {

// A person whose next velocity a model computes.
struct Walker {
  Person person;        // with the desired speed among the robots
  Vec2 way;             // desired direction, a unit vector; zero on the target
  std::uint32_t slot;   // in the crowd
  double robot_weight;  // of the influence of robots: `robot_awareness`, or as the person's reaction has it

  double weight_of(const Body& other) const { return other.slot == no_slot ? robot_weight : other.weight; }
};

// The host numbers people by slot, which is unrelated to their positions. gather() reads everything that is stored by
// slot once, in this order; the model then visits people cell by cell. So neither accesses the memory of a large crowd
// at random.
class Walkers {
 public:
  // `grid`: the one that people walk on. Its arrays must outlive this object.
  void start(std::uint64_t seed, const toolkit::GridView& grid, const ReactionShares& shares) {
    right_of_way_.start();
    past_robots_.start(seed, grid);
    reactions_.start(seed, grid, shares);
  }

  // Fills `neighbors` with all people and, unless nobody is aware of them, with the robots. Calls way_of(slot, person)
  // once for each person, in the order of slots. Allocates only if there are more people than in all steps before.
  template <class WayOf>
  void gather(const Crowd& crowd, double robot_awareness, NeighborGrid& neighbors, const WayOf& way_of) {
    bodies_.clear();
    wishes_.clear();
    right_of_way_.begin_step();
    past_robots_.begin_step();
    reactions_.begin_step();
    bool any_aware = false;
    const double step_s = seconds(crowd.dt_ns);
    for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
      const Person& person = crowd.people[slot];
      bodies_.push_back({person.position, person.velocity, person.radius_m, 1.0, slot});
      Vec2 way = way_of(slot, person);
      double speed = person.desired_speed;
      const double robot_weight = weight_of_robots(person, robot_awareness);
      any_aware = any_aware || robot_weight > 0.0;
      if (const auto wish = reactions_.wish(person, way, crowd.robots, step_s)) {
        way = wish->way;
        speed = wish->speed;
      } else if (robot_weight > 0.0) {
        way = past_robots_.direction(person, way, crowd.robots, step_s);
      }
      wishes_.push_back({way, speed, robot_weight});
      right_of_way_.update(person, way, step_s);
    }
    if (any_aware)
      for (const Agent& robot : crowd.robots)
        bodies_.push_back({toolkit::position(robot.pose), robot.velocity, robot.radius_m, 1.0, no_slot});
    neighbors.build(bodies_);

    by_place_.clear();
    for (const Body& body : neighbors.by_place())
      if (body.slot != no_slot) {
        const Wish& wish = wishes_[body.slot];
        by_place_.push_back({crowd.people[body.slot], wish.way, body.slot, wish.robot_weight});
        by_place_.back().person.desired_speed = wish.speed;
      }
  }

  // In the order of neighbors.by_place().
  const std::vector<Walker>& by_place() const { return by_place_; }

  const RightOfWay& right_of_way() const { return right_of_way_; }

 private:
  struct Wish {
    Vec2 way;
    double speed;
    double robot_weight;
  };

  double weight_of_robots(const Person& person, double robot_awareness) const {
    const std::uint32_t reaction = reactions_.of(person);
    if (reaction == DMRP_REACTION_REGULAR) return 1.0;
    return reaction == DMRP_REACTION_IMPASSIVE ? 0.0 : robot_awareness;
  }

  std::vector<Body> bodies_;
  std::vector<Wish> wishes_;  // by slot
  RightOfWay right_of_way_;
  WaysPastRobots past_robots_;
  RobotReactions reactions_;
  std::vector<Walker> by_place_;
};

}  // namespace dmrp::pedestrians
