// SPDX-License-Identifier: MIT
// blocked_time.hpp: the time in which robots make no progress, by its cause.
#pragma once

#include <dmrp/robot_event.h>

#include <array>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

class BlockedTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Times {
    bool measured = false;                                   // was active in at least one step
    std::array<std::int64_t, DMRP_CLASS_STUCK + 1> ns = {};  // by class
    std::int64_t circling_ns = 0;
  };

  RefereeClasses classes_;
  std::vector<Times> times_;  // by robot
};

}  // namespace dmrp::metrics
