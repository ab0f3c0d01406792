// SPDX-License-Identifier: MIT
// bench_simulation_world.hpp: worlds for measurements.
#pragma once

#include <cstdint>

#include "core/scene/scenario.hpp"

namespace dmrp::bench {

// The shipped mall: 40 x 40 m, 4 robots, 12 people.
core::Scenario shipped_mall();

// A hall of 100 x 60 m with rows of pillars: people walk along it in both directions, robots across.
core::Scenario make_hall(std::uint32_t robots, std::uint32_t people);

}  // namespace dmrp::bench
