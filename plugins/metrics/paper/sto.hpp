// SPDX-License-Identifier: MIT
// sto.hpp: spatio-temporal overlap: the share of planned waypoints near another robot's at about the same time.
#pragma once

#include <vector>

#include "metrics/measure/first_plan_metric.hpp"

namespace dmrp::metrics {

class Sto final : public FirstPlanMetric {
 public:
  static Descriptor describe();
  Param<double> distance_m =
      param("distance_m", 0.5).unit("m").range(0.0, 100.0).doc("D: waypoints at most this far apart overlap");
  Param<std::int64_t> window =
      param("window", 2).unit("1").range(0, 1000).doc("k: waypoints at most this many steps apart overlap");

  Param<std::vector<double>> distances_m =
      param("distances_m", std::vector<double>{0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0})
          .unit("m")
          .range(0.0, 100.0)
          .doc("values of D for the curve sto_by_distance");

  void finish(const TrialEnd& end, MetricSink& sink) override;
};

}  // namespace dmrp::metrics
