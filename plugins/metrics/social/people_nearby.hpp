// SPDX-License-Identifier: MIT
// people_nearby.hpp: the number of people around a robot.
#pragma once

#include <dmrp/plugin.hpp>

#include "metrics/measure/mean_count.hpp"

namespace dmrp::metrics {

class PeopleNearby final : public Metric {
 public:
  static Descriptor describe();
  Param<double> radius_m =
      param("radius_m", 5.0).unit("m").range(0.0, 1000.0).doc("people at most this far away, centre to centre, count");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  MeanCount near_;
};

}  // namespace dmrp::metrics
