// SPDX-License-Identifier: MIT
// planning_time.hpp: the wall time of the first planner call.
#pragma once

#include "metrics/measure/first_plan_metric.hpp"

namespace dmrp::metrics {

class PlanningTime final : public FirstPlanMetric {
 public:
  static Descriptor describe();
  void finish(const TrialEnd& end, MetricSink& sink) override;
};

}  // namespace dmrp::metrics
