// SPDX-License-Identifier: MIT
// processor_time.hpp: the processor time of this process.
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace dmrp::host {

// Nanoseconds that the process has computed, all its threads together, to the microsecond. Other programs on the machine
// do not add to it. (CLOCK_PROCESS_CPUTIME_ID moves in ticks of milliseconds once RLIMIT_CPU is set, as in the box.)
inline std::int64_t processor_time_ns() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const std::int64_t seconds = used.ru_utime.tv_sec + used.ru_stime.tv_sec;
  const std::int64_t microseconds = used.ru_utime.tv_usec + used.ru_stime.tv_usec;
  return (seconds * 1'000'000 + microseconds) * 1'000;
}

}  // namespace dmrp::host
