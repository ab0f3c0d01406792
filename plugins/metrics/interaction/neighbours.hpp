// SPDX-License-Identifier: MIT
// neighbours.hpp: how many other robots a robot has around it on its way.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "../measure/active_steps.hpp"

namespace dmrp::metrics {

class Neighbours final : public Metric {
 public:
  static Descriptor describe();
  Param<double> radius_m =
      param("radius_m", 2.0).unit("m").range(0.0, 1000.0).doc("R: robots at most this far away, centre to centre");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Time while active, and the same with every neighbour counted: integers, so exact.
  struct Times {
    std::int64_t active_ns = 0;
    std::int64_t neighbour_ns = 0;
  };

  ActiveSteps active_;
  std::vector<Times> times_;  // a robot
};

}  // namespace dmrp::metrics
