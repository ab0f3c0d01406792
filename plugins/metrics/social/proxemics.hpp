// SPDX-License-Identifier: MIT
// proxemics.hpp: shares of time in people's intimate, personal and social space.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/time_share.hpp"

namespace dmrp::metrics {

class Proxemics final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Shares {
    TimeShare intimate, personal, social;
  };

  ActiveSteps active_;
  std::vector<Shares> shares_;  // by robot
};

}  // namespace dmrp::metrics
