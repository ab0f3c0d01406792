// SPDX-License-Identifier: MIT
// resource_limits.hpp: what a process that runs plugins may use up.
#pragma once

#include <cstdint>

namespace dmrp::host {

// Bounds the address space of this process (0: not at all; never under sanitizers), and forbids core dumps.
void set_resource_limits(std::int64_t memory_mb);

}  // namespace dmrp::host
