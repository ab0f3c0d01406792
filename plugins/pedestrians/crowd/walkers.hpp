// SPDX-License-Identifier: MIT
// Everybody of a step in the order of their places.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/right_of_way.hpp"

namespace dmrp::pedestrians {

// Somebody whose next velocity is sought.
struct Walker {
  Person person;
  dmrp_vec2 way;       // where they want to set out, a unit vector; zero on the target
  std::uint32_t slot;  // in the crowd
};

// People come by slot, which says nothing about where they are. What belongs to their slots is read in that order once,
// and the rest of the step goes from neighbour to neighbour: neither runs through a large crowd's memory at random.
class Walkers {
 public:
  void start() { right_of_way_.start(); }

  // Sorts all people, and robots where they are minded, into `neighbors`. way_of(slot, person) is asked once each, slot
  // by slot. Allocates only where there are more than ever before.
  template <class WayOf>
  void gather(const Crowd& crowd, double robot_awareness, NeighborGrid& neighbors, const WayOf& way_of) {
    bodies_.clear();
    ways_.clear();
    right_of_way_.begin_step();
    const double step_s = seconds(crowd.dt_ns);
    for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
      const Person& person = crowd.people[slot];
      bodies_.push_back({person.position, person.velocity, person.radius_m, 1.0, slot});
      ways_.push_back(way_of(slot, person));
      right_of_way_.note(person, ways_.back(), step_s);
    }
    if (robot_awareness > 0.0)
      for (const Agent& robot : crowd.robots)
        bodies_.push_back({toolkit::position(robot.pose), robot.velocity, robot.radius_m, robot_awareness, no_slot});
    neighbors.build(bodies_);

    by_place_.clear();
    for (const Body& body : neighbors.by_place())
      if (body.slot != no_slot) by_place_.push_back({crowd.people[body.slot], ways_[body.slot], body.slot});
  }

  // As neighbors.by_place() has them.
  const std::vector<Walker>& by_place() const { return by_place_; }

  const RightOfWay& right_of_way() const { return right_of_way_; }

 private:
  std::vector<Body> bodies_;
  std::vector<dmrp_vec2> ways_;  // by slot
  RightOfWay right_of_way_;
  std::vector<Walker> by_place_;
};

}  // namespace dmrp::pedestrians
