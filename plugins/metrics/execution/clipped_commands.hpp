// SPDX-License-Identifier: MIT
// clipped_commands.hpp: how often a controller asked for more than the robot's drive can do.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class ClippedCommands final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  std::vector<double> counts_;  // by robot; undefined if planning failed
};

}  // namespace dmrp::metrics
