// SPDX-License-Identifier: MIT
// planning_time.hpp: the wall time of the first planner call.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class PlanningTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override { first_plan_ = plan; }
  void observe(const Sample&) override {}
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  const dmrp_plan* first_plan_ = nullptr;
};

}  // namespace dmrp::metrics
