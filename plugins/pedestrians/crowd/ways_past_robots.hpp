// SPDX-License-Identifier: MIT
// Ways of people whom a robot holds up.
//
// The models alone let a person stand before a waiting robot for ever, and the robot waits for the person. Here people
// lose their patience (Helbing, Buzna, Johansson, Werner: Self-organized pedestrian crowd dynamics, Transportation
// Science 39 (2005): impatience grows while somebody is slower than desired). A person whom a robot ahead holds up for
// some seconds
//
//   - goes round it, on the side that costs the smaller detour, where there is room for the body;
//   - otherwise walks back and lets it pass, for some seconds more each time that they meet again.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/grid_view.hpp>

#include "pedestrians/crowd/encounters.hpp"

namespace dmrp::pedestrians {

class WaysPastRobots {
 public:
  // The grid's arrays must outlive this object.
  void start(std::uint64_t seed, const toolkit::GridView& grid);

  // Call begin_step() at every step, then direction() once for each person: the desired direction among the robots, a
  // unit vector, given the one without them.
  void begin_step() { forget_unseen(encounters_); }
  Vec2 direction(const Person& person, Vec2 way, const Span<Agent>& robots, double step_s);

 private:
  enum class Does : std::uint8_t { walk, pass, step_back };

  // Of a person whom a robot holds up or has held up lately.
  struct Encounter {
    Does does = Does::walk;
    Vec2 trail = {0.0, 0.0};   // behind the person: the exponentially weighted mean of the positions
    double held_up_s = 0.0;    // while walking: for how long
    double patience_s = 0.0;   // until the person does something about it
    double remaining_s = 0.0;  // of passing or stepping back
    double side = 1.0;         // of passing: 1 leaves the robot on the right, -1 on the left
    std::uint32_t attempts = 0;
    bool is_seen = true;  // in this step
  };

  void begin(Encounter& encounter, Does does, const Person& person, Vec2 way) const;
  void give_way(Encounter& encounter, const Person& person, Vec2 way, const Agent& robot) const;
  bool has_room(const Person& person, const Agent& robot, double side) const;

  std::uint64_t seed_ = 0;
  toolkit::GridView grid_;
  Encounters<Encounter> encounters_;
};

}  // namespace dmrp::pedestrians
