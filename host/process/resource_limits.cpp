// SPDX-License-Identifier: MIT
#include "host/process/resource_limits.hpp"

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

double processor_time_s(double wall_s, unsigned sharers) {
  return wall_s * std::max(1u, std::thread::hardware_concurrency() / std::max(1u, sharers));
}

void limit_files(std::int64_t file_mb) {
  const rlimit files = {static_cast<rlim_t>(file_mb) << 20, static_cast<rlim_t>(file_mb) << 20};
  setrlimit(RLIMIT_FSIZE, &files);
}

}  // namespace dmrp::host
