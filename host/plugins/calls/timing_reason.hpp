// SPDX-License-Identifier: MIT
// timing_reason.hpp: why a trial depends on timing, and so is not repeatable.
#pragma once

#include <string>

namespace dmrp::host {

struct TimingReason {
  std::string plugin;  // its id
  std::string text;    // one line

  bool operator==(const TimingReason&) const = default;
};

}  // namespace dmrp::host
