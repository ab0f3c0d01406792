// SPDX-License-Identifier: MIT
// blocked_time.hpp: how long robots that have set out make no progress.
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
  Param<double> window_s =
      param("window_s", 2.0).unit("s").range(0.001, 1000.0).doc("time without progress that counts as blocked");
  Param<double> progress_m = param("progress_m", 0.1)
                                 .unit("m")
                                 .range(0.0, 100.0)
                                 .doc("gaining less than this along the path in a window is no progress");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  struct Watched {
    bool measured = false;  // was active in some step
    bool started = false;
    RecentProgress progress;
    UnionLength blocked;
  };

  ActiveSteps active_;
  std::vector<Watched> watched_;  // a robot
};

}  // namespace dmrp::metrics
