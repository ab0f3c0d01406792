// SPDX-License-Identifier: MIT
// first_places.hpp: where the people of flows are at t = 0.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/people/walking_groups.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// Where a person begins, and the leg of its flow that leads on from there.
struct FirstPlace {
  dmrp_vec2 position{};
  std::uint32_t leg = 0;
};

// Somebody of a flow found no place.
struct NoRoom : std::runtime_error {
  NoRoom(std::uint32_t index, const std::string& text) : std::runtime_error(text), flow(index) {}
  std::uint32_t flow;  // index into Scenario::flows
};

// By slot. `room`: without the people who are to be placed. Each group's draws are of a stream of its own; those who
// start in a region share one, the smallest region first: where regions overlap, it has the least room to evade. There
// people who are all alone stand on a jittered hexagonal lattice as wide as the region permits, for densities that
// people drawn one by one do not reach; where there are groups, on one in which companions are near. Throws NoRoom if
// there is none for everybody.
std::vector<FirstPlace> first_places(const Scenario& scenario, const FlowRoutes& routes, const StandingRoom& room,
                                     std::uint64_t seed);

}  // namespace dmrp::core
