// SPDX-License-Identifier: MIT
// kaplan_meier.hpp: survival analysis of times to an event, some of them censored: the product-limit estimate (Kaplan,
// Meier: Nonparametric estimation from incomplete observations, JASA 53, 1958) and its restricted mean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/bootstrap.hpp"
#include "core/statistics/resampling.hpp"

namespace dmrp::core {

struct TimeToEvent {
  double time = 0.0;
  bool happened = false;      // false: censored, no event until `time`
  std::uint64_t cluster = 0;  // of dependent cases: a seed
};

// The survival function: the share of cases without an event after each event time, ordered by time. A case that is
// censored at an event time counts as observed at that time.
struct SurvivalStep {
  double time;
  double share;
};
std::vector<SurvivalStep> kaplan_meier(std::span<const TimeToEvent> cases);

// The area under the survival function up to the horizon: the mean of the time to the event or the horizon, whichever
// is earlier. If the last case is censored before the horizon, its share extends to the horizon. NaN without cases.
double restricted_mean(std::span<const TimeToEvent> cases, double horizon);

// A 95 % interval of the restricted mean by the bootstrap over clusters; needs at least two clusters.
Interval restricted_mean_interval(std::span<const TimeToEvent> cases, double horizon,
                                  const BootstrapSettings& settings = {});

// The same over a resampling of tasks: `cluster` is the task of a case. Needs two observations.
Interval restricted_mean_interval(std::span<const TimeToEvent> cases, double horizon, const Resampling& resampling);

}  // namespace dmrp::core
