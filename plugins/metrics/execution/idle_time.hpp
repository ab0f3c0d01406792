// SPDX-License-Identifier: MIT
// idle_time.hpp: how long robots stand still on their way.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"

namespace dmrp::metrics {

class IdleTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Times {
    std::int64_t active_ns = 0;
    std::int64_t idle_ns = 0;
  };

  ActiveSteps active_;
  std::vector<Times> times_;  // a robot
};

}  // namespace dmrp::metrics
