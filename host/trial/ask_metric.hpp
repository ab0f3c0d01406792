// SPDX-License-Identifier: MIT
// ask_metric.hpp: a metric's guest measures a finished trace.
#pragma once

#include <cstdint>
#include <span>

#include "host/experiment/experiment.hpp"
#include "host/guests/guests.hpp"
#include "host/results/trial_record.hpp"
#include "host/world/variant_world.hpp"

namespace dmrp::host {

// What a metric is asked about.
struct FinishedTrial {
  std::span<const std::uint8_t> records;  // none: they are in the spool of the guests (GuestProcess)
  const VariantWorld* variant = nullptr;  // nullptr: the trace alone tells of its world
  std::uint32_t robots = 0;
  std::uint64_t seed = 0;
  double sim_time_s = 0.0;
};

// How long a call of a metric may take: step_time_s for a small trial, and more as robots and their time grow. At its end a
// metric may look at all robots and at all that they did.
std::int64_t metric_budget_ns(double step_time_s, const FinishedTrial& trial);

// `index` goes into the result. Throws PluginFault.
MetricResult ask_metric(Guests& guests, const PluginUse& metric, std::uint32_t index, const FinishedTrial& trial,
                        double step_time_s);

// What a metric's guest gave as the result, once all in it can be from the metric. Throws UnbelievableMessage.
MetricResult believed(MetricResult given, const PluginInfo& metric, std::uint32_t robots, std::uint32_t index);

}  // namespace dmrp::host
