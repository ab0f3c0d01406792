// SPDX-License-Identifier: MIT
// path_length.hpp: driven length, planned length and planned turns.
#pragma once

#include <dmrp/plugin.hpp>

#include "metrics/measure/driven_length.hpp"

namespace dmrp::metrics {

class PathLength final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  const dmrp_plan* first_plan_ = nullptr;
  DrivenLength driven_;
};

}  // namespace dmrp::metrics
