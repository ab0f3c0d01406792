// SPDX-License-Identifier: MIT
#include "metrics/outcome/planning_time.hpp"

#include "metrics/measure/describe_metric.hpp"

namespace dmrp::metrics {

Descriptor PlanningTime::describe() {
  return describe_metric("dmrp.metric.planning_time", "Planning time")
      .summary("wall time of the call that made the first plan")
      .source("Hu et al., DMRP-Bench, ICRA 2026: planning time")
      .value(
          "planning_time", "ms", Direction::lower_is_better, Subjects::system,
          "wall time of the first call of plan(), as in the paper's Table II, without replans, which solve easier or "
          "harder problems; undefined if planning failed")
      .wall_clock();
}

void PlanningTime::finish(const TrialEnd&, MetricSink& sink) {
  const bool planned = first_plan_ && !world().robots().empty();
  sink.system("planning_time", planned ? static_cast<double>(first_plan_->planning_ns) / 1e6 : undefined);
}

}  // namespace dmrp::metrics
