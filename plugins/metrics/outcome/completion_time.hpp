// SPDX-License-Identifier: MIT
// completion_time.hpp: the times of arrival, and the duration of the trial.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class CompletionTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan*) override {}
  void observe(const Sample&) override {}
  void finish(const TrialEnd& end, MetricSink& sink) override;
};

}  // namespace dmrp::metrics
