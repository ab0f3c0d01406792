// SPDX-License-Identifier: MIT
// monotonic_time.hpp: the clock that all processes of a run share.
#pragma once

#include <cstdint>
#include <ctime>

namespace dmrp::host {

// Nanoseconds of CLOCK_MONOTONIC.
inline std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

}  // namespace dmrp::host
