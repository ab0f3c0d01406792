// SPDX-License-Identifier: MIT
// Priority between people who block each other.
//
// Models in which all people evade each other alike cannot resolve this: at a door, two people can turn each other back
// for ever (prolonged clogs: Xu, Chraibi, Seyfried, Prolonged clogs in bottleneck simulations for pedestrian dynamics,
// Physica A 573 (2021)). Here a blocked person ignores the people ahead who have farther to go, so somebody always
// moves first.
//
// A person is *blocked* when the exponentially weighted mean of their progress (time constant 5 s) falls below 3 % of
// the desired speed, until it rises above 9 %. A person who stops completely counts as blocked after 17 s; the
// stop-and-go waves of a dense crowd are shorter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

#include "pedestrians/crowd/neighbor_grid.hpp"

namespace dmrp::pedestrians {

class RightOfWay {
 public:
  void start() { progress_.clear(); }

  // Call begin_step() at every step, then update() for all people by slot, with their desired directions.
  void begin_step();
  void update(const Person& person, Vec2 way, double step_s);

  // Whether the person in this slot is blocked and may ignore the body: a person ahead who has farther to go. Never a
  // robot.
  bool ignores(std::uint32_t slot, const Body& body, const Span<Person>& people) const {
    const Progress& progress = progress_[slot];
    return progress.is_blocked && body.slot != no_slot &&
           toolkit::dot(progress.way, body.position - people[slot].position) > 0.0 &&
           has_priority(people[slot], people[body.slot]);
  }

 private:
  struct Progress {
    std::uint64_t person_id = 0;
    double mean_speed = 0.0;  // along the desired direction, exponentially weighted, m/s
    bool is_blocked = false;
    Vec2 way = {0.0, 0.0};
  };

  static bool has_priority(const Person& one, const Person& other);

  std::vector<Progress> progress_;  // by slot
  std::vector<Progress> before_;    // by slot, of the last step
  std::size_t next_before_ = 0;     // in before_: where the search for the next person begins
};

}  // namespace dmrp::pedestrians
