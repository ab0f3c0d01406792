// SPDX-License-Identifier: MIT
// kaplan_meier.hpp: times until something happened, of which some were cut short: the product-limit estimate
// (Kaplan, Meier: Nonparametric estimation from incomplete observations, JASA 53, 1958) and its restricted mean.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/statistics/bootstrap.hpp"

namespace dmrp::core {

struct TimeToEvent {
  double time = 0.0;
  bool happened = false;      // false: it had not yet, when watching ended at `time`
  std::uint64_t cluster = 0;  // what it belongs to: a seed
};

// The share to whom it has not happened after each time at which it did, by time. A case that is cut short at such a
// time was still watched at it.
struct SurvivalStep {
  double time;
  double share;
};
std::vector<SurvivalStep> kaplan_meier(std::span<const TimeToEvent> cases);

// The area under that curve up to the horizon: the mean time until it happened or the horizon came. Where the last case
// was cut short before the horizon, its share lasts until there. NaN of no case.
double restricted_mean(std::span<const TimeToEvent> cases, double horizon);

// A 95 % interval for it by the bootstrap over clusters; of two clusters or more.
Interval restricted_mean_interval(std::span<const TimeToEvent> cases, double horizon,
                                  const BootstrapSettings& settings = {});

}  // namespace dmrp::core
