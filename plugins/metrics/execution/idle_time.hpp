// SPDX-License-Identifier: MIT
// idle_time.hpp: the time in which robots stand still before they arrive.
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
  std::vector<Times> times_;  // by robot
};

}  // namespace dmrp::metrics
