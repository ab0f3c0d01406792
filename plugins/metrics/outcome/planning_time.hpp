// SPDX-License-Identifier: MIT
// planning_time.hpp: the processor time of the first planner call.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <optional>

namespace dmrp::metrics {

class PlanningTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  bool planned_ = false;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace dmrp::metrics
