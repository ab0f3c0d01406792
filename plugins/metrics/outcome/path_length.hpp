// SPDX-License-Identifier: MIT
// path_length.hpp: how far the robots drove, and how far and with how many turns they were told to.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class PathLength final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  const dmrp_plan* first_plan_ = nullptr;
  std::vector<CompensatedSum> driven_m_;
  std::vector<Vec2> last_position_;  // empty before the first sample
};

}  // namespace dmrp::metrics
