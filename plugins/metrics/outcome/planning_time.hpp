// SPDX-License-Identifier: MIT
// planning_time.hpp: the processor time of the first planner call.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class PlanningTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample&) override {}
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  double planning_time_ms_ = undefined;
};

}  // namespace dmrp::metrics
