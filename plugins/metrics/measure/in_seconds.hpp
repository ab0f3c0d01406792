// SPDX-License-Identifier: MIT
// in_seconds.hpp: times as results give them.
#pragma once

#include <cstdint>

namespace dmrp::metrics {

// One rounding, so that 0.3 s is the double nearest to 0.3.
inline double in_seconds(std::int64_t ns) {
  return static_cast<double>(ns) / 1e9;
}

}  // namespace dmrp::metrics
