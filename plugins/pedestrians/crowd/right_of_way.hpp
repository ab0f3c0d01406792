// SPDX-License-Identifier: MIT
// Who waits for whom where people are in each other's way and nobody gets on.
//
// Models in which all turn aside alike have no answer to that: at a door two people turn each other back for ever
// (prolonged clogs: Xu, Chraibi, Seyfried, Prolonged clogs in bottleneck simulations for pedestrian dynamics, Physica A
// 573 (2021)). So who is held up minds only those who have less far to go, and somebody always goes first.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <vector>

#include "crowd/neighbor_grid.hpp"

namespace dmrp::pedestrians {

class RightOfWay {
 public:
  void start() { progress_.clear(); }

  // To be told of everybody at every step.
  void update(const Span<Person>& people, double step_s);

  // Whether the person in this slot is held up, getting on by next to nothing for seconds, and the body is that of
  // somebody who has farther to go.
  bool holds_over(std::uint32_t slot, const Body& body, const Span<Person>& people) const {
    return progress_[slot].is_held_up && body.slot != no_slot && goes_before(people[slot], people[body.slot]);
  }

 private:
  struct Progress {
    std::uint64_t person_id = 0;
    dmrp_vec2 velocity = {0.0, 0.0};  // mean, the older the less
    bool is_held_up = false;
  };

  static bool goes_before(const Person& one, const Person& other);

  std::vector<Progress> progress_;  // by slot
  std::vector<Progress> before_;    // likewise, of the last step
};

}  // namespace dmrp::pedestrians
