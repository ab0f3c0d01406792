// SPDX-License-Identifier: MIT
// neighbours.hpp: the number of other robots around a robot.
#pragma once

#include <dmrp/plugin.hpp>

#include "metrics/measure/mean_count.hpp"

namespace dmrp::metrics {

class Neighbours final : public Metric {
 public:
  static Descriptor describe();
  Param<double> radius_m = param("radius_m", 2.0)
                               .unit("m")
                               .range(0.0, 1000.0)
                               .doc("R: robots at most this far away count, centre to centre");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  MeanCount near_;
};

}  // namespace dmrp::metrics
