// SPDX-License-Identifier: MIT
// A small preference for one side, which breaks the symmetry of encounters.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <vector>

namespace dmrp::pedestrians {

// Turns each person's desired direction by a constant angle of up to 0.001 rad. The angle is too small to see, but
// without it two people who meet in perfect symmetry would never pass each other.
class SidePreference {
 public:
  void start(std::uint64_t seed);

  // Turns the unit vector `direction` for the person in this slot. The length of the result is 1 within 1e-6.
  Vec2 apply(std::size_t slot, const Person& person, Vec2 direction);

 private:
  struct Turn {
    std::uint64_t person_id;
    double angle;  // rad
  };

  std::uint64_t seed_ = 0;
  std::vector<Turn> turns_;  // by slot
};

}  // namespace dmrp::pedestrians
