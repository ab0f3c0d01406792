// SPDX-License-Identifier: MIT
// Who waits for whom where people are in each other's way and nobody gets on.
//
// Models in which all turn aside alike have no answer to that: at a door two people turn each other back for ever
// (prolonged clogs: Xu, Chraibi, Seyfried, Prolonged clogs in bottleneck simulations for pedestrian dynamics, Physica A
// 573 (2021)). So who is held up no longer minds those before them who have farther to go, and somebody always goes first.
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

  // At every step: first this, then everybody by slot, with the way on which they want to set out.
  void begin_step();
  void note(const Person& person, dmrp_vec2 way, double step_s);

  // Whether the person in this slot is held up, getting on by next to nothing for seconds, and the body is that of
  // somebody before them who has farther to go.
  bool holds_over(std::uint32_t slot, const Body& body, const Span<Person>& people) const {
    const Progress& progress = progress_[slot];
    return progress.is_held_up && body.slot != no_slot &&
           toolkit::dot(progress.way, body.position - people[slot].position) > 0.0 &&
           goes_before(people[slot], people[body.slot]);
  }

 private:
  struct Progress {
    std::uint64_t person_id = 0;
    double speed = 0.0;  // along their ways, mean, the older the less; m/s
    bool is_held_up = false;
    dmrp_vec2 way = {0.0, 0.0};
  };

  static bool goes_before(const Person& one, const Person& other);

  std::vector<Progress> progress_;  // by slot
  std::vector<Progress> before_;    // likewise, of the last step
  std::size_t next_before_ = 0;     // of those in before_, who may come next
};

}  // namespace dmrp::pedestrians
