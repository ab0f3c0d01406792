// SPDX-License-Identifier: MIT
// ask_metric.hpp: a metric's guest measures a finished trace.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/experiment/experiment.hpp"
#include "host/guests/guests.hpp"
#include "host/results/trial_record.hpp"
#include "host/trial/world/variant_world.hpp"

namespace dmrp::host {

// What a metric is asked about.
struct FinishedTrial {
  std::span<const std::uint8_t> records;  // none: they are in the spool of the guests (GuestProcess)
  const VariantWorld* variant = nullptr;  // nullptr: the trace alone tells of its world
  std::uint32_t robots = 0;
  std::uint64_t seed = 0;
};

// `index` goes into the result. Throws PluginFault.
MetricResult ask_metric(Guests& guests, const PluginUse& metric, std::uint32_t index, const FinishedTrial& trial,
                        std::int64_t call_budget_ns);

// Why a metric's guest cannot have got this result from the metric, in one line; nothing if it can.
std::optional<std::string> breach_of(const MetricResult& result, const PluginInfo& metric, std::uint32_t robots);

}  // namespace dmrp::host
