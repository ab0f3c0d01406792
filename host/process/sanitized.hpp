// SPDX-License-Identifier: MIT
// sanitized.hpp: sanitizers reserve terabytes of address space, and start processes of their own.
#pragma once

namespace dmrp::host {

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DMRP_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(DMRP_SANITIZED)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace dmrp::host
