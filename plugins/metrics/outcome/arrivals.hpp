// SPDX-License-Identifier: MIT
// arrivals.hpp: the outcome in the terms of multi-agent path finding: who came to its goal, when, how many goals a time.
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
  std::vector<std::uint32_t> goal_index_;  // a robot: its current goal at the last sample
};

}  // namespace dmrp::metrics
