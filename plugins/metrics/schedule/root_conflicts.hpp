// SPDX-License-Identifier: MIT
// root_conflicts.hpp: which conflicts of the robots' own shortest paths a plan resolves by waiting, and which by a detour.
#pragma once

#include <dmrp/plugin.hpp>

namespace dmrp::metrics {

class RootConflicts final : public Metric {
 public:
  static Descriptor describe();

  void begin(const dmrp_plan* plan) override { first_plan_ = plan; }
  void observe(const Sample&) override {}
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  const dmrp_plan* first_plan_ = nullptr;
};

}  // namespace dmrp::metrics
