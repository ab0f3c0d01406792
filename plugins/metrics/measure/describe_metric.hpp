// SPDX-License-Identifier: MIT
// describe_metric.hpp: the common part of the descriptors of all built-in metrics.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

inline Descriptor describe_metric(const char* id, const char* name) {
  return Descriptor(id, name, "0.1.0").vendor("dmrp").license("MIT");
}

}  // namespace dmrp::metrics
