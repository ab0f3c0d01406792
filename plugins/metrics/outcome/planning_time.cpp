// SPDX-License-Identifier: MIT
#include "metrics/outcome/planning_time.hpp"

#include <dmrp/draft/processor_time.h>

#include "metrics/measure/describe_metric.hpp"

namespace dmrp::metrics {

Descriptor PlanningTime::describe() {
  return describe_metric("dmrp.metric.planning_time", "Planning time")
      .summary("processor time of the call that made the first plan")
      .source("Hu et al., DMRP-Bench, ICRA 2026: planning time")
      .channels(DMRP_CHANNEL_CALLS)
      .value("planning_time", "ms", Direction::lower_is_better, Subjects::system,
             "processor time of the first plan, all threads; undefined if planning failed, and in traces that have "
             "wall times alone")
      .wall_clock();
}

void PlanningTime::begin(const dmrp_plan* plan) {
  planned_ = plan != nullptr && !world().robots().empty();
  first_ns_.reset();
}

void PlanningTime::observe(const Sample& sample) {
  if (first_ns_) return;
  for (const Call& call : sample.calls)
    if (call.kind == DMRP_CALL_PLAN_PROCESSOR_TIME && !first_ns_) first_ns_ = call.duration_ns;
}

void PlanningTime::finish(const TrialEnd&, MetricSink& sink) {
  sink.system("planning_time", planned_ && first_ns_ ? static_cast<double>(*first_ns_) / 1e6 : undefined);
}

}  // namespace dmrp::metrics
