// SPDX-License-Identifier: MIT
// measure.hpp: runs a metric over an encoded trace, during a run as for stored traces.
#pragma once

#include <cstdint>
#include <memory>

#include "core/trace/trace_reader.hpp"
#include "host/results/trial_record.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/trial/walking_grids.hpp"

namespace dmrp::host {

// Rewinds the trace, starts the metric on the trace's world, whose grids are `walking_grids`, and measures the trace.
// `info` describes the metric, `index` goes into the result. Throws PluginFault, and std::invalid_argument if the trace has no end.
MetricResult measure(core::TraceReader& trace, const std::shared_ptr<WalkingGrids>& walking_grids, Instance& metric,
                     const PluginInfo& info, std::uint32_t index, std::uint64_t seed, std::int64_t call_budget_ns);

}  // namespace dmrp::host
