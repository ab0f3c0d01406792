// SPDX-License-Identifier: MIT
// completion_time.hpp: the times of arrival, and the duration of the trial.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class CompletionTime final : public FirstPlanMetric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.completion_time", "Completion time")
        .summary("simulated time until the robots arrived, and until the trial ended")
        .source("Hu et al., DMRP-Bench, ICRA 2026: completion time")
        .value("completion_time", "s", lower_is_better, system_and_robots,
               "time of the robot's final arrival; system: the last, undefined unless all arrive", never_negative)
        .value("mission_time", "s", lower_is_better, Subjects::system, "end of the trial for any reason",
               never_negative);
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::int64_t last_ns = 0;
    bool all = !end.robots.empty();
    for (std::size_t robot = 0; robot < end.robots.size(); ++robot) {
      const std::int64_t arrival_ns = end.robots[robot].arrival_ns;
      sink.robot("completion_time", robot, arrival_ns >= 0 ? in_seconds(arrival_ns) : undefined);
      last_ns = std::max(last_ns, arrival_ns);
      all = all && arrival_ns >= 0;
    }
    sink.system("completion_time", all ? in_seconds(last_ns) : undefined);
    sink.system("mission_time", in_seconds(end.t_ns));
  }
};

}  // namespace dmrp::metrics
