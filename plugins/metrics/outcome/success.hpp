// SPDX-License-Identifier: MIT
// success.hpp: who arrived, and who did so without a contact of its own fault.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class Success final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  std::vector<char> at_fault_;  // a robot: whether it had a contact of its own fault
};

}  // namespace dmrp::metrics
