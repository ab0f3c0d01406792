// SPDX-License-Identifier: MIT
#include "host/process/resource_limits.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace dmrp::host {

namespace {

// Sanitizers reserve terabytes of address space.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DMRP_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(DMRP_SANITIZED)
constexpr bool can_limit_address_space = false;
#else
constexpr bool can_limit_address_space = true;
#endif

}  // namespace

void set_resource_limits(std::int64_t memory_mb) {
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (!can_limit_address_space || memory_mb == 0) return;
  rlimit memory{};
  getrlimit(RLIMIT_AS, &memory);  // a tighter one stays
  memory.rlim_cur = std::min(static_cast<rlim_t>(memory_mb) << 20, memory.rlim_cur);
  memory.rlim_max = memory.rlim_cur;
  setrlimit(RLIMIT_AS, &memory);
}

}  // namespace dmrp::host
