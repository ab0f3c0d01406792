// SPDX-License-Identifier: MIT
// processor_time.hpp: the processor time of this process.
#pragma once

#include <cstdint>
#include <ctime>

namespace dmrp::host {

// Nanoseconds that the process has computed, all its threads together. Other programs on the machine do not add to it.
inline std::int64_t processor_time_ns() {
  timespec used{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<std::int64_t>(used.tv_sec) * 1'000'000'000 + used.tv_nsec;
}

}  // namespace dmrp::host
