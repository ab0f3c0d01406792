// SPDX-License-Identifier: MIT
// The people of one step, sorted by their places in the neighbour grid.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/right_of_way.hpp"
#include "pedestrians/crowd/ways_past_robots.hpp"

namespace dmrp::pedestrians {

// A person whose next velocity a model computes.
struct Walker {
  Person person;
  Vec2 way;            // desired direction, a unit vector; zero on the target
  std::uint32_t slot;  // in the crowd
};

// The host numbers people by slot, which is unrelated to their positions. gather() reads everything that is stored by
// slot once, in this order; the model then visits people cell by cell. So neither accesses the memory of a large crowd
// at random.
class Walkers {
 public:
  // `grid`: the one that people walk on. Its arrays must outlive this object.
  void start(std::uint64_t seed, const toolkit::GridView& grid) {
    right_of_way_.start();
    past_robots_.start(seed, grid);
  }

  // Fills `neighbors` with all people and, unless `robot_awareness` is 0, with the robots. Calls way_of(slot, person)
  // once for each person, in the order of slots. Allocates only if there are more people than in all steps before.
  template <class WayOf>
  void gather(const Crowd& crowd, double robot_awareness, NeighborGrid& neighbors, const WayOf& way_of) {
    bodies_.clear();
    ways_.clear();
    right_of_way_.begin_step();
    past_robots_.begin_step();
    const double step_s = seconds(crowd.dt_ns);
    for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
      const Person& person = crowd.people[slot];
      bodies_.push_back({person.position, person.velocity, person.radius_m, 1.0, slot});
      Vec2 way = way_of(slot, person);
      if (robot_awareness > 0.0) way = past_robots_.direction(person, way, crowd.robots, step_s);
      ways_.push_back(way);
      right_of_way_.update(person, ways_.back(), step_s);
    }
    if (robot_awareness > 0.0)
      for (const Agent& robot : crowd.robots)
        bodies_.push_back({toolkit::position(robot.pose), robot.velocity, robot.radius_m, robot_awareness, no_slot});
    neighbors.build(bodies_);

    by_place_.clear();
    for (const Body& body : neighbors.by_place())
      if (body.slot != no_slot) by_place_.push_back({crowd.people[body.slot], ways_[body.slot], body.slot});
  }

  // In the order of neighbors.by_place().
  const std::vector<Walker>& by_place() const { return by_place_; }

  const RightOfWay& right_of_way() const { return right_of_way_; }

 private:
  std::vector<Body> bodies_;
  std::vector<Vec2> ways_;  // by slot
  RightOfWay right_of_way_;
  WaysPastRobots past_robots_;
  std::vector<Walker> by_place_;
};

}  // namespace dmrp::pedestrians
