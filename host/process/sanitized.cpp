// SPDX-License-Identifier: MIT
#include "host/process/sanitized.hpp"

namespace dmrp::host {

// Not in the header: tests, whose own sources are not instrumented, ask too.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DMRP_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(DMRP_SANITIZED)
constinit const bool is_sanitized = true;
#else
constinit const bool is_sanitized = false;
#endif

}  // namespace dmrp::host
