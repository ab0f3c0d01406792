// SPDX-License-Identifier: MIT
// The people of one step, sorted by their places in the neighbour grid, and their neighbours.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/neighbor_grid.hpp"
#include "pedestrians/crowd/reactions.hpp"

namespace dmrp::pedestrians {

// A person whose next velocity a model computes.
struct Walker {
  Person person;        // with the desired speed that their reactions leave
  Vec2 way;             // desired direction, a unit vector; zero on the target
  std::uint32_t slot;   // in the crowd
  double robot_weight;  // of the influence of robots
};

// A body that has an influence on a walker.
struct Neighbor {
  const Body* body;
  double squared_distance;  // above 0
  double weight;            // of the influence, above 0
  bool is_ignored;          // the walker presses on as if it were not there
};

// The host numbers people by slot, which is unrelated to their positions. gather() reads everything that is stored by
// slot once, in this order; the model then visits people cell by cell. So neither accesses the memory of a large crowd
// at random.
class Walkers {
 public:
  Reactions reactions;
  NeighborGrid grid;

  // Puts all people and robots into the grid. Calls way_of(slot, person) once for each person, in the order of slots.
  // Allocates only if there are more people than in all steps before. The crowd's arrays must outlive the last call of
  // visit_neighbors().
  template <class WayOf>
  void gather(const Crowd& crowd, const WayOf& way_of) {
    people_ = crowd.people;
    bodies_.clear();
    wishes_.clear();
    reactions.begin_step();
    for (std::uint32_t slot = 0; slot < crowd.people.size(); ++slot) {
      const Person& person = crowd.people[slot];
      bodies_.push_back({person.position, person.velocity, person.radius_m, slot});
      wishes_.push_back(reactions.wish(person, way_of(slot, person), crowd.robots, seconds(crowd.dt_ns)));
    }
    for (const Agent& robot : crowd.robots)
      bodies_.push_back({toolkit::position(robot.pose), robot.velocity, robot.radius_m, no_slot});
    grid.build(bodies_);

    by_place_.clear();
    for (const Body& body : grid.by_place())
      if (body.slot != no_slot) {
        const Wish& wish = wishes_[body.slot];
        by_place_.push_back({people_[body.slot], wish.way, body.slot, wish.robot_weight});
        by_place_.back().person.desired_speed = wish.speed;
      }
  }

  // In the order of grid.by_place().
  const std::vector<Walker>& by_place() const { return by_place_; }

  // Calls visit(neighbor) for the walker's neighbours within `reach_m`, in the order of the grid.
  template <class Visit>
  void visit_neighbors(const Walker& walker, double reach_m, const Visit& visit) {
    for (const auto& [squared_distance, body] : grid.near(walker.person.position, reach_m)) {
      const double weight = body->slot == no_slot ? walker.robot_weight : 1.0;
      if (body->slot == walker.slot || !(squared_distance > 0.0) || !(weight > 0.0)) continue;
      visit(Neighbor{body, squared_distance, weight, reactions.ignores(walker.slot, *body, people_)});
    }
  }

 private:
  Span<Person> people_;
  std::vector<Body> bodies_;
  std::vector<Wish> wishes_;  // by slot
  std::vector<Walker> by_place_;
};

}  // namespace dmrp::pedestrians
