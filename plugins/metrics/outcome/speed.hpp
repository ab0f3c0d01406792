// SPDX-License-Identifier: MIT
// speed.hpp: mean and standard deviation of the robots' speeds.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class Speed final : public ActiveTimeMetric<TimeMoments> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.speed", "Speed")
        .summary("each robot's measured speed until it arrives")
        .source("Hu et al., DMRP-Bench, ICRA 2026: mean speed, speed standard deviation")
        .value("mean_speed", "m/s", higher_is_better, system_and_robots,
               "mean over active time of the robot's measured |v|; undefined if planning failed", never_negative)
        .value("speed_sd", "m/s", lower_is_better, system_and_robots,
               "standard deviation over active time of the robot's measured |v|; undefined if planning failed",
               never_negative);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "mean_speed", &TimeMoments::mean);
    give_mean(sink, "speed_sd", &TimeMoments::standard_deviation);
  }

 private:
  void add_step(TimeMoments& speed, std::size_t robot, const Sample& sample) override {
    speed.add(speed_of(sample.robots[robot]), sample.dt_ns);
  }
};

}  // namespace dmrp::metrics
