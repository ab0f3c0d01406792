// SPDX-License-Identifier: MIT
// pfd.hpp: path following deviation: the distance of robots from their planned paths.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/sums.hpp"

namespace dmrp::metrics {

class Pfd final : public Metric {
 public:
  static Descriptor describe();
  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // One robot's distances. All statistics are NaN without a distance.
  struct Deviation {
    CompensatedSum sum_m;
    std::size_t count = 0;
    double greatest_m = undefined;
    double running_mean_m = 0.0;  // Welford (1962)
    double squares = 0.0;         // sum of squared differences from the mean
    void add(double distance_m);
    double mean_m() const;
    double standard_deviation_m() const;  // normalised by n
  };

  const dmrp_plan* first_plan_ = nullptr;
  ActiveSteps active_;
  std::vector<Deviation> in_force_;
  std::vector<Deviation> initial_;
};

}  // namespace dmrp::metrics
