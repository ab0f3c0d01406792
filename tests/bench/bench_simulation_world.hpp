// SPDX-License-Identifier: MIT
// bench_simulation_world.hpp: worlds to measure in.
#pragma once

#include <cstdint>

#include "core/scene/scenario.hpp"

namespace dmrp::bench {

// The mall as it is shipped: 40 x 40 m, 4 robots, 12 people.
core::Scenario shipped_mall();

// 100 x 60 m with rows of pillars, for many: people walk to and fro along it, robots across.
core::Scenario make_hall(std::uint32_t robots, std::uint32_t people);

}  // namespace dmrp::bench
