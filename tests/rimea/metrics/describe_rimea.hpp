// SPDX-License-Identifier: MIT
// describe_rimea.hpp: the common part of these metrics' descriptors, and shared functions.
#pragma once

#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/rectangle.hpp>
#include <vector>

namespace dmrp::rimea {

inline Descriptor describe_rimea(const char* id, const char* name) {
  return Descriptor(id, name, "1.0.0")
      .vendor("dmrp")
      .license("MIT")
      .source("RiMEA guideline 4.1.1 (2025), appendix: verification and validation")
      .channels(DMRP_CHANNEL_PEOPLE);
}

// The rectangle of two corners [x, y]. Throws std::invalid_argument unless the first is the lower left one.
toolkit::Rectangle rectangle_of(const std::vector<double>& lower_m, const std::vector<double>& upper_m);

// Whether a time is a multiple of the interval. Experiments must use intervals that are multiples of the step.
inline bool is_due(std::int64_t t_ns, double interval_s) {
  return t_ns % static_cast<std::int64_t>(interval_s * 1e9 + 0.5) == 0;
}

}  // namespace dmrp::rimea
