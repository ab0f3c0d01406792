// SPDX-License-Identifier: MIT
// symbol_hooks.hpp: functions of the C library, replaced in this process where libraries call them, to see what a plugin
// does with clocks and memory. The host's own program keeps the originals.
#pragma once

#include <cstdint>
#include <span>

namespace dmrp::host {

class CallGuard;

// From now on each look at a clock finds it this much later than it would be. Libraries that are loaded later keep true
// clocks.
inline constexpr std::int64_t clock_leap_ns = 50'000'000;
void let_clocks_leap();

// Lets the same clocks tell this much more from now on.
void let_clocks_be_off(std::int64_t ns);

// Memory that libraries allocate from now on is full of this.
void fill_new_memory(std::uint8_t byte);

// What calls of a plugin have allocated since count_allocations().
struct Allocations {
  std::int64_t count = 0;
  std::int64_t bytes = 0;
  std::int64_t kept_bytes = 0;  // less what calls have freed
};

// Counts from now on, in calls of this guard, which outlives the process.
void count_allocations(const CallGuard& guard);
Allocations allocations();

// What calls of this guard allocate from now on lies behind fences (fence.hpp).
void fence_allocations(const CallGuard& guard);

}  // namespace dmrp::host
