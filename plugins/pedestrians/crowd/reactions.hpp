// SPDX-License-Identifier: MIT
// What people do beyond the published models: they take the right of way where they block each other, get past robots
// that hold them up or step back, and answer to the sight of a robot. Off, all do as the model has it.
#pragma once

#include "pedestrians/crowd/right_of_way.hpp"
#include "pedestrians/crowd/robot_reactions.hpp"
#include "pedestrians/crowd/ways_past_robots.hpp"

namespace dmrp::pedestrians {

class Reactions {
 public:
  // `robot_awareness`: the weight of the influence of robots. The grid's arrays must outlive this object. Throws
  // std::invalid_argument if the shares add up to more than 1, or for any share while this is off.
  void start(std::uint64_t seed, const toolkit::GridView& grid, bool is_on, double robot_awareness,
             const ReactionShares& shares);

  // Call begin_step() at every step, then wish() once for each person, by slot, with the way to the target.
  void begin_step();
  Wish wish(const Person& person, Vec2 way, const Span<Agent>& robots, double step_s);

  // Whether somebody's own reaction has had no effect since start(), because this is off.
  bool leaves_out_own() const { return leaves_out_own_; }

  // Whether the person in this slot presses on as if that body were not there.
  bool ignores(std::uint32_t slot, const Body& body, const Span<Person>& people) const {
    return is_on_ && right_of_way_.ignores(slot, body, people);
  }

 private:
  bool is_on_ = true;
  bool leaves_out_own_ = false;
  double robot_awareness_ = 1.0;
  RightOfWay right_of_way_;
  WaysPastRobots past_robots_;
  RobotReactions to_robots_;
};

}  // namespace dmrp::pedestrians
