// SPDX-License-Identifier: MIT
// measure.hpp: runs a metric over an encoded trace: the one code path, live and for stored traces.
#pragma once

#include <cstdint>

#include "core/trace_reader.hpp"
#include "host/trial/instance_pool.hpp"
#include "host/workers/messages.hpp"

namespace dmrp::host {

// Rewinds the trace and measures it. Throws PluginFault; values that the metric gave before are lost.
MetricResult measure(core::TraceReader& trace, Instance& metric, const PluginInfo& info, std::uint32_t index,
                     std::uint64_t seed, std::int64_t call_budget_ns);

}  // namespace dmrp::host
