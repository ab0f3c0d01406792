// SPDX-License-Identifier: MIT
// time_to_collision.hpp: the time until a robot would hit somebody if all kept their velocities.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/bodies.hpp"
#include "metrics/measure/time_share.hpp"

namespace dmrp::metrics {

class TimeToCollision final : public Metric {
 public:
  static Descriptor describe();
  Param<double> threshold_s =
      param("threshold_s", 1.5).unit("s").range(0.0, 1000.0).doc("a time to collision below this is a conflict");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Times {
    double least_s = undefined;
    TimeShare below;
  };

  ActiveSteps active_;
  std::vector<Times> times_;    // by robot
  std::vector<Moving> robots_;  // at the sample
};

}  // namespace dmrp::metrics
