// SPDX-License-Identifier: MIT
// sanitized.hpp: sanitizers reserve terabytes of address space, and start processes of their own.
#pragma once

#include <dlfcn.h>

namespace dmrp::host {

// Whether the host is built with the address or thread sanitizer.
extern const bool is_sanitized;

// Also where a sanitizer was loaded for a plugin's sake, by LD_PRELOAD.
inline bool sanitizer_is_loaded() {
  static const bool loaded = is_sanitized || dlsym(RTLD_DEFAULT, "__asan_init") || dlsym(RTLD_DEFAULT, "__tsan_init");
  return loaded;
}

}  // namespace dmrp::host
