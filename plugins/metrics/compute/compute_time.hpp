// SPDX-License-Identifier: MIT
// compute_time.hpp: wall time of planner and controller calls, and the share of calls that took too long.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

namespace dmrp::metrics {

class ComputeTime final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Calls {
    std::vector<std::int64_t> durations_ns;
    std::size_t missed = 0;
    double mean_ms() const;
    double p99_ms() const;  // nearest rank: the smallest duration that 99 % of the calls do not exceed
    double missed_percent() const;
  };

  Calls planning_;
  std::vector<Calls> control_;  // by robot
  Calls central_;               // of a controller of all robots
};

}  // namespace dmrp::metrics
