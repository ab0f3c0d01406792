// SPDX-License-Identifier: MIT
#include "metrics/outcome/planning_time.hpp"

#include "metrics/measure/describe_metric.hpp"

namespace dmrp::metrics {

Descriptor PlanningTime::describe() {
  return describe_metric("dmrp.metric.planning_time", "Planning time")
      .summary("processor time of the call that made the first plan")
      .source("Hu et al., DMRP-Bench, ICRA 2026: planning time")
      .value("planning_time", "ms", Direction::lower_is_better, Subjects::system,
             "processor time of the first plan, all threads; undefined if planning failed")
      .wall_clock();
}

void PlanningTime::begin(const dmrp_plan* plan) {
  const bool is_known = plan && plan->processor_ns >= 0 && !world().robots().empty();
  planning_time_ms_ = is_known ? static_cast<double>(plan->processor_ns) / 1e6 : undefined;
}

void PlanningTime::finish(const TrialEnd&, MetricSink& sink) {
  sink.system("planning_time", planning_time_ms_);
}

}  // namespace dmrp::metrics
