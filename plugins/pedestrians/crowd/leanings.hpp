// SPDX-License-Identifier: MIT
// Which way people lean where both sides are as good.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <vector>

namespace dmrp::pedestrians {

// Wishes are turned by up to 0.001 rad, drawn once a person from the stream "pedestrian.leaning": nothing that one could
// see, and yet no two people meet in perfect symmetry, in which neither would give way.
class Leanings {
 public:
  void start(std::uint64_t seed);

  // The unit vector as the person in this slot turns it; its length is 1 but for 1e-6.
  dmrp_vec2 lean(std::size_t slot, const Person& person, dmrp_vec2 direction);

 private:
  struct Leaning {
    std::uint64_t person_id;
    double turn;  // rad
  };

  std::uint64_t seed_ = 0;
  std::vector<Leaning> leanings_;  // by slot
};

}  // namespace dmrp::pedestrians
