// SPDX-License-Identifier: MIT
// spl.hpp: success weighted by path length.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class Spl final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  std::vector<CompensatedSum> driven_m_;
  std::vector<Vec2> last_position_;  // empty before the first sample
};

}  // namespace dmrp::metrics
