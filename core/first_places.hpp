// SPDX-License-Identifier: MIT
// first_places.hpp: where the people of flows are at t = 0.
#pragma once

#include <cstdint>
#include <vector>

#include "core/flow_routes.hpp"
#include "core/scenario.hpp"
#include "core/walking_groups.hpp"

namespace dmrp::core {

// Where a person begins, and the leg of its flow that leads on from there.
struct FirstPlace {
  dmrp_vec2 position{};
  std::uint32_t leg = 0;
};

// By slot. `room`: without the people who are to be placed. Each group's draws are of a stream of its own; those who
// start in a region share one. Throws std::runtime_error if there is no room for everybody.
std::vector<FirstPlace> first_places(const Scenario& scenario, const FlowRoutes& routes, const StandingRoom& room,
                                     std::uint64_t seed);

// The people who start in a region, of all flows.
struct RegionCrowd {
  std::uint32_t region = 0;
  std::vector<std::uint32_t> group_sizes;  // in order of slots
  bool rows_along_x = false;               // of companions: across the first flow's way

  std::size_t people() const;
};

// The smallest region first: where regions overlap, it has the least room to evade.
std::vector<RegionCrowd> crowds_by_region(const Scenario& scenario);

// Places for them, parallel to group_sizes; for fewer groups where there is no room for more. People who are all alone
// stand on a jittered hexagonal lattice as wide as the region permits, for densities that people drawn one by one do not
// reach; where there are groups, on one in which companions are near.
std::vector<std::vector<dmrp_vec2>> places_in_region(const Scenario& scenario, const RegionCrowd& crowd,
                                                     const StandingRoom& room, std::uint64_t seed);

}  // namespace dmrp::core
