// SPDX-License-Identifier: MIT
// spl.hpp: success weighted by path length.
#pragma once

#include <dmrp/plugin.hpp>

#include "metrics/measure/driven_length.hpp"

namespace dmrp::metrics {

class Spl final : public Metric {
 public:
  static Descriptor describe();
  Status start(const Start& start) override;
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  const dmrp_walking_grid* walking_grid_ = nullptr;
  DrivenLength driven_;
};

}  // namespace dmrp::metrics
