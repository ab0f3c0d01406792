// SPDX-License-Identifier: MIT
// ldf.hpp: local density fluctuation: the variance of the number of robots around a robot.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"

namespace dmrp::metrics {

class Ldf final : public Metric {
 public:
  static Descriptor describe();
  Param<double> distance_m =
      param("distance_m", 2.0).unit("m").range(0.0, 100.0).doc("R: robots at most this far away are neighbours");
  Param<double> period_s = param("period_s", 1.0).unit("s").range(0.001, 60.0).doc("time between two counts");
  Param<std::vector<double>> distances_m = param("distances_m", std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0})
                                               .unit("m")
                                               .range(0.0, 100.0)
                                               .doc("values of R for the curve ldf_by_distance");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  // Counts of neighbours. Their variance is computed with integers, so only the last division rounds.
  struct Counts {
    std::int64_t instants = 0, sum = 0, squares = 0;
    void add(std::int64_t neighbours, std::int64_t times);
    double variance() const;  // normalised by n; NaN without an instant
  };

  void count_neighbours(const Sample& sample, std::int64_t times);
  void count_by_distance(std::size_t robot, std::int64_t times);

  std::int64_t period_ns_ = 0;
  std::int64_t next_ns_ = 0;  // the next instant of counting
  ActiveSteps active_;
  std::vector<double> squared_distances_;  // from one robot to the others, at one instant
  std::vector<Counts> all_;                // by robot: all robots, over the whole trial
  std::vector<Counts> active_only_;        // by robot: active robots, while active itself
  std::vector<Counts> by_distance_;        // as all_, for each of distances_m
};

}  // namespace dmrp::metrics
