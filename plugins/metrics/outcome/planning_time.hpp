// SPDX-License-Identifier: MIT
// planning_time.hpp: the processor time of the first planner call.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class PlanningTime final : public FirstPlanMetric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.planning_time", "Planning time")
        .summary("processor time of the call that made the first plan")
        .source("Hu et al., DMRP-Bench, ICRA 2026: planning time")
        .value("planning_time", "ms", lower_is_better, Subjects::system,
               "processor time of the first plan, all threads; undefined if planning failed", never_negative)
        .wall_clock();
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    const bool is_known = first_plan_ && first_plan_->processor_ns >= 0 && !world().robots().empty();
    sink.system("planning_time", is_known ? static_cast<double>(first_plan_->processor_ns) / 1e6 : undefined);
  }
};

}  // namespace dmrp::metrics
