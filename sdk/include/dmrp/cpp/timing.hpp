// SPDX-License-Identifier: MIT
// cpp/timing.hpp: the draft extension draft/timing.h for Plugin::find_extension<dmrp_timing>(). plugin.hpp does not include
// it, as dmrp.h does not.
#pragma once

#include "../draft/timing.h"
#include "extensions.hpp"

namespace dmrp {

template <>
struct ExtensionId<dmrp_timing> {
  DMRP_LOCAL static constexpr const char* value = DMRP_DRAFT_TIMING;
};

}  // namespace dmrp
