// SPDX-License-Identifier: MIT
// first_places.hpp: the positions of the people of flows at t = 0.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/people/flow_routes.hpp"
#include "core/people/walking_groups.hpp"
#include "core/scene/scenario.hpp"

namespace dmrp::core {

// The first position of a person, and the leg of its flow that begins there.
struct FirstPlace {
  dmrp_vec2 position{};
  std::uint32_t leg = 0;
};

// There is no room for all people of a flow.
struct NoRoom : std::runtime_error {
  NoRoom(std::uint32_t index, const std::string& text) : std::runtime_error(text), flow(index) {}
  std::uint32_t flow;  // index into Scenario::flows
};

// Returns positions by slot. `room` excludes the people to be placed. Each group along a flow has its own random
// stream; people who start in a region share one. Regions are filled in order of size, the smallest first, because it
// has the least room for alternatives where regions overlap. In a region, people without groups stand on a jittered
// hexagonal lattice as wide as the region permits, for densities that people drawn one by one would not reach; with
// groups, members get neighbouring points. Throws NoRoom if there is no room for everybody.
std::vector<FirstPlace> first_places(const Scenario& scenario, const FlowRoutes& routes, const StandingRoom& room,
                                     std::uint64_t seed);

}  // namespace dmrp::core
