// SPDX-License-Identifier: MIT
// cpp/trial_end.hpp: how a trial ended; the contract is in ../trial_end.h.
#pragma once

#include <cstdint>

#include "../trial_end.h"
#include "span.hpp"

namespace dmrp {

using RobotEnd = dmrp_robot_end;

// dmrp_trial_end with a span.
struct TrialEnd {
  explicit TrialEnd(const dmrp_trial_end& c)
      : ending(c.ending), t_ns(c.t_ns), robots(c.robots, c.robot_count, c.robot_stride) {}

  std::uint32_t ending;  // DMRP_ENDING_*
  std::int64_t t_ns;
  Span<RobotEnd> robots;
};

}  // namespace dmrp
