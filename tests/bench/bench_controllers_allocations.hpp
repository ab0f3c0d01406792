// SPDX-License-Identifier: MIT
// bench_controllers_allocations.hpp: counts the program's allocations, those of plugin libraries included.
#pragma once

#include <cstdint>

namespace dmrp::bench {

// Blocks that malloc and its kin have given out since the program began (operator new among them).
std::uint64_t allocations();

}  // namespace dmrp::bench
