// SPDX-License-Identifier: MIT
#include "pedestrians/crowd/side_preference.hpp"

#include <dmrp/toolkit/random.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

namespace {

constexpr double largest_angle = 1e-3;

// The stream's name decides the numbers: another name would change the results of every seed.
constexpr const char* stream_name = "pedestrian.leaning";

}  // namespace

void SidePreference::start(std::uint64_t seed) {
  seed_ = seed;
  turns_.clear();
}

Vec2 SidePreference::apply(std::size_t slot, const Person& person, Vec2 direction) {
  if (slot >= turns_.size()) turns_.resize(slot + 1, {~person.id, 0.0});
  Turn& turn = turns_[slot];
  if (turn.person_id != person.id)
    turn = {person.id, toolkit::Stream(seed_, stream_name, person.id).uniform(-largest_angle, largest_angle)};
  return direction + turn.angle * toolkit::perpendicular(direction);
}

}  // namespace dmrp::pedestrians
