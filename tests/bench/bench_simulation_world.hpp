// SPDX-License-Identifier: MIT
// bench_simulation_world.hpp: worlds to measure in.
#pragma once

#include <cstdint>

#include "core/scenario.hpp"

namespace dmrp::bench {

// 40 x 40 m: a thoroughfare from west to east, shops with doors on both sides of it, stalls, benches and planters.
// Robots stand in two rows in the thoroughfare and cross it; people walk along it both ways.
core::Scenario make_mall(std::uint32_t robots, std::uint32_t people);

// 100 x 60 m with rows of pillars, for many: people walk to and fro along it, robots across.
core::Scenario make_hall(std::uint32_t robots, std::uint32_t people);

}  // namespace dmrp::bench
