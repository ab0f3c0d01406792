// SPDX-License-Identifier: MIT
// kaplan_meier.hpp: survival analysis of times to an event, some of them censored: the product-limit estimate (Kaplan,
// Meier: Nonparametric estimation from incomplete observations, JASA 53, 1958).
#pragma once

#include <span>
#include <vector>

namespace dmrp::core {

struct TimeToEvent {
  double time = 0.0;
  bool happened = false;  // false: censored, no event until `time`
};

// The survival function: the share of cases without an event after each event time, ordered by time. A case that is
// censored at an event time counts as observed at that time. Where nobody is censored before a horizon, the area under it
// up to there is the mean of the time or the horizon, whichever is earlier.
struct SurvivalStep {
  double time;
  double share;
};
std::vector<SurvivalStep> kaplan_meier(std::span<const TimeToEvent> cases);

}  // namespace dmrp::core
