// SPDX-License-Identifier: MIT
#include "host/process/resource_limits.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <thread>

#include "host/process/sanitized.hpp"

namespace dmrp::host {

void set_resource_limits(std::int64_t memory_mb) {
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (sanitizer_is_loaded() || memory_mb == 0) return;
  rlimit memory{};
  getrlimit(RLIMIT_DATA, &memory);  // a tighter one stays
  memory.rlim_cur = std::min(static_cast<rlim_t>(memory_mb) << 20, memory.rlim_cur);
  memory.rlim_max = memory.rlim_cur;
  setrlimit(RLIMIT_DATA, &memory);
}

std::string lack_of_memory(std::int64_t memory_mb) {
  rlim_t least = RLIM_INFINITY;
  for (const auto resource : {RLIMIT_DATA, RLIMIT_AS}) {
    rlimit now{};
    if (getrlimit(resource, &now) == 0) least = std::min(least, now.rlim_cur);
  }
  if (least != RLIM_INFINITY && (memory_mb == 0 || static_cast<std::int64_t>(least >> 20) < memory_mb))
    return fmt::format("found no more memory: the shell or job allows a process {} MB (ulimit -v, -d)", least >> 20);
  if (memory_mb == 0) return "found no more memory: the machine has none left";
  return fmt::format("needs more than {} MB of memory", memory_mb);
}

double processor_time_s(double wall_s, unsigned sharers) {
  return wall_s * std::max(1u, std::thread::hardware_concurrency() / std::max(1u, sharers));
}

void limit_files(std::int64_t file_mb) {
  const rlimit files = {static_cast<rlim_t>(file_mb) << 20, static_cast<rlim_t>(file_mb) << 20};
  setrlimit(RLIMIT_FSIZE, &files);
}

}  // namespace dmrp::host
