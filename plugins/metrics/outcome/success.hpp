// SPDX-License-Identifier: MIT
// success.hpp: robots that arrived, and robots that did so without a contact at their fault.
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
  std::vector<char> at_fault_;  // by robot: whether it had a contact at its fault
  std::vector<char> touched_;   // by robot: whether it had any contact
};

}  // namespace dmrp::metrics
