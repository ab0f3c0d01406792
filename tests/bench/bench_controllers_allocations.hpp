// SPDX-License-Identifier: MIT
// bench_controllers_allocations.hpp: counts the program's allocations, including those of plugin libraries.
#pragma once

#include <cstdint>

namespace dmrp::bench {

// The number of blocks allocated by malloc and related functions (including operator new) since the program started.
std::uint64_t allocations();

}  // namespace dmrp::bench
