// SPDX-License-Identifier: MIT
// sto_physical.hpp: spatio-temporal overlap of plans in metres and seconds, whatever their cells and steps.
#pragma once

#include "metrics/measure/first_plan_metric.hpp"

namespace dmrp::metrics {

class StoPhysical final : public FirstPlanMetric {
 public:
  static Descriptor describe();
  Param<double> distance_m =
      param("distance_m", 0.5).unit("m").range(0.0, 100.0).doc("positions at most this far apart overlap");
  Param<double> window_s = param("window_s", 3.6).unit("s").range(0.0, 1000.0).doc("greatest difference of times");

  void finish(const TrialEnd& end, MetricSink& sink) override;
};

}  // namespace dmrp::metrics
