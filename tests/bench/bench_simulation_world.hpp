// SPDX-License-Identifier: MIT
// bench_simulation_world.hpp: a world to measure in, of the size and furniture of a shopping mall.
#pragma once

#include <cstdint>

#include "core/scenario.hpp"

namespace dmrp::bench {

// 40 x 40 m: a thoroughfare from west to east, shops with doors on both sides of it, stalls, benches and planters.
// Robots stand in two rows in the thoroughfare and cross it; people walk along it both ways.
core::Scenario make_mall(std::uint32_t robots, std::uint32_t people);

}  // namespace dmrp::bench
