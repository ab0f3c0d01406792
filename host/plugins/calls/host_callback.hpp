// SPDX-License-Identifier: MIT
// host_callback.hpp: functions that plugins call throw nothing.
#pragma once

#include <dmrp/status.h>

#include <cstdint>
#include <new>

namespace dmrp::host {

// Runs the body of a callback; an exception becomes a status.
template <class Body>
std::int32_t or_out_of_memory(Body&& body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return DMRP_OUT_OF_MEMORY;
  } catch (...) {
    return DMRP_ERROR;
  }
}

}  // namespace dmrp::host
