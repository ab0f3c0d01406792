// SPDX-License-Identifier: MIT
// first_cause.hpp: why robots failed, through all that waited for one another.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

class FirstCause final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  RefereeClasses classes_;
  std::vector<bool> runs_on_;  // by robot: it was at a standstill that ran on
};

}  // namespace dmrp::metrics
