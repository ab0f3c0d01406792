// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/leanings.hpp"

#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

constexpr double widest_turn = 1e-3;

}  // namespace

void Leanings::start(std::uint64_t seed) {
  seed_ = seed;
  leanings_.clear();
}

dmrp_vec2 Leanings::lean(std::size_t slot, const Person& person, dmrp_vec2 direction) {
  if (slot >= leanings_.size()) leanings_.resize(slot + 1, {~person.id, 0.0});
  Leaning& leaning = leanings_[slot];
  if (leaning.person_id != person.id)
    leaning = {person.id, toolkit::Stream(seed_, "pedestrian.leaning", person.id).uniform(-widest_turn, widest_turn)};
  return direction + leaning.turn * toolkit::perpendicular(direction);
}

}  // namespace dmrp::pedestrians
