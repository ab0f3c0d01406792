// SPDX-License-Identifier: MIT
// blocked_time.hpp: the time in which robots make no progress after they first moved.
#pragma once

#include <dmrp/plugin.hpp>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/recent_progress.hpp"
#include "metrics/measure/time_span.hpp"

namespace dmrp::metrics {

class BlockedTime final : public Metric {
 public:
  static Descriptor describe();
  Param<double> window_s = param("window_s", 2.0)
                               .unit("s")
                               .range(0.001, 1000.0)
                               .doc("a robot without progress for this time counts as blocked");
  Param<double> progress_m =
      param("progress_m", 0.1).unit("m").range(0.0, 100.0).doc("less than this within a window is no progress");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct RobotProgress {
    bool measured = false;  // was active in at least one step
    bool started = false;
    RecentProgress progress;
    UnionLength blocked;
  };

  ActiveSteps active_;
  std::vector<RobotProgress> robots_;  // by robot
};

}  // namespace dmrp::metrics
