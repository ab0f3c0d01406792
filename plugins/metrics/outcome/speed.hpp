// SPDX-License-Identifier: MIT
// speed.hpp: mean and standard deviation of the robots' speeds.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class Speed final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  ActiveSteps active_;
  std::vector<TimeMoments> speed_;
};

}  // namespace dmrp::metrics
