// SPDX-License-Identifier: MIT
// measure.hpp: runs a metric over an encoded trace: the one code path, live and for stored traces.
#pragma once

#include <cstdint>

#include "core/trace/trace_reader.hpp"
#include "host/results/trial_record.hpp"
#include "host/trial/instance_pool.hpp"

namespace dmrp::host {

// Rewinds the trace, which outlives the call, and measures it; the metric is started on the trace's world. `info`
// describes the metric, `index` goes into the result. Throws PluginFault; values that the metric gave before are lost.
// Throws std::invalid_argument where the trace has no end.
MetricResult measure(core::TraceReader& trace, Instance& metric, const PluginInfo& info, std::uint32_t index,
                     std::uint64_t seed, std::int64_t call_budget_ns);

}  // namespace dmrp::host
