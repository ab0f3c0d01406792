// SPDX-License-Identifier: MIT
// What is known of people while they meet robots.
#pragma once

#include <cstdint>
#include <dmrp/cpp/pedestrian_model.hpp>
#include <map>

namespace dmrp::pedestrians {

template <class Encounter>
using Encounters = std::map<std::uint64_t, Encounter>;  // by person

// Begins a step: forgets people who have not been seen (`is_seen`) since the last call.
template <class Encounter>
void forget_unseen(Encounters<Encounter>& encounters) {
  std::erase_if(encounters, [](const auto& one) { return !one.second.is_seen; });
  for (auto& [person, encounter] : encounters) encounter.is_seen = false;
}

// The robot of the least far(robot), of equals the first; nullptr without robots.
template <class Far>
const Agent* nearest(const Span<Agent>& robots, const Far& far) {
  const Agent* found = nullptr;
  for (const Agent& robot : robots)
    if (found == nullptr || far(robot) < far(*found)) found = &robot;
  return found;
}

}  // namespace dmrp::pedestrians
