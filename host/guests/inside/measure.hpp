// SPDX-License-Identifier: MIT
// measure.hpp: runs a metric over an encoded trace, during a run as for stored traces.
#pragma once

#include <dmrp/metric.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/trace/trace_reader.hpp"
#include "host/plugins/instance.hpp"
#include "host/results/trial_record.hpp"
#include "host/world/walking_grids.hpp"

namespace dmrp::host {

// A metric's functions, one after the other: begin(), observe() for each sample, finish(). They throw PluginFault.
class Measurement {
 public:
  // `index` goes into the result. The metric has been started.
  Measurement(Instance& metric, const PluginInfo& info, std::uint32_t index, std::uint32_t robot_count,
              std::int64_t call_budget_ns);

  void begin(const dmrp_metric_trial& trial);
  // What the metric does not declare (descriptor.h, DMRP_CHANNEL_*) it does not get.
  void observe(const dmrp_sample& sample);
  MetricResult finish(const dmrp_trial_end& end);

 private:
  void leave_out_recoveries(dmrp_sample& sample);

  Instance& metric_;
  const PluginInfo& info_;
  std::uint32_t index_;
  std::uint32_t robot_count_;
  std::int64_t call_budget_ns_;
  dmrp_metric table_;
  std::vector<std::byte> shown_;   // a sample as the metric gets it
  std::vector<std::byte> events_;  // its events, where some are left out
  std::int64_t step_ = 0;
};

// Rewinds the trace, starts the metric on the trace's world, whose grids are `walking_grids`, and measures the trace.
// `info` describes the metric, `index` goes into the result. Throws PluginFault, and std::invalid_argument if the trace has no end.
MetricResult measure(core::TraceReader& trace, const std::shared_ptr<WalkingGrids>& walking_grids, Instance& metric,
                     const PluginInfo& info, std::uint32_t index, std::uint64_t seed, std::int64_t call_budget_ns);

}  // namespace dmrp::host
