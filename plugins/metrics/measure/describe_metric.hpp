// SPDX-License-Identifier: MIT
// describe_metric.hpp: what the descriptors of all built-in metrics have in common.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

inline Descriptor describe_metric(const char* id, const char* name) {
  return Descriptor(id, name, "0.1.0").vendor("dmrp").license("MIT");
}

}  // namespace dmrp::metrics
