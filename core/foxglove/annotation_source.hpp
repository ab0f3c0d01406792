// SPDX-License-Identifier: MIT
// annotation_source.hpp: identifies the plugin behind a trajectory or a note in the trace.
#pragma once

#include <cstdint>

namespace dmrp::core {

struct AnnotationSource {
  std::uint32_t plugin_kind = 0;  // DMRP_KIND_*
  std::uint32_t robot = 0;        // that it is about; 0 where the plugin is not a controller
};

}  // namespace dmrp::core
