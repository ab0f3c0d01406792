// SPDX-License-Identifier: MIT
// arrivals.hpp: the outcome in terms of multi-agent path finding: success rates, flowtime, makespan, throughput.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class Arrivals final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  std::vector<std::uint32_t> goal_index_;  // by robot: its current goal at the last sample
};

}  // namespace dmrp::metrics
