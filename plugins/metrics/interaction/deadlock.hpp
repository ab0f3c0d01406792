// SPDX-License-Identifier: MIT
// deadlock.hpp: cycles of robots that wait for each other.
//
// A robot waits for another if it makes no progress along its path and the other is the first robot in its way: within
// `margin_m` of the strip that its body would sweep from its position to its place on the path and along the path for
// `look_ahead_m`. So each robot waits for at most one other, the members identify a cycle, and robots outside that wait
// for a member do not change it.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>
#include <vector>

#include "metrics/measure/active_steps.hpp"
#include "metrics/measure/recent_progress.hpp"

namespace dmrp::metrics {

class Deadlock final : public Metric {
 public:
  static Descriptor describe();
  Param<double> lasting_s = param("lasting_s", 5.0)
                                .unit("s")
                                .range(0.0, 10000.0)
                                .doc("T: a cycle that lasts at least this long is a deadlock");
  Param<double> window_s =
      param("window_s", 2.0).unit("s").range(0.001, 1000.0).doc("a robot without progress for this time waits");
  Param<double> progress_m =
      param("progress_m", 0.1).unit("m").range(0.0, 100.0).doc("less than this within a window is no progress");
  Param<double> look_ahead_m =
      param("look_ahead_m", 1.0).unit("m").range(0.0, 100.0).doc("length of path ahead in which robots are in the way");
  Param<double> margin_m =
      param("margin_m", 0.1).unit("m").range(0.0, 100.0).doc("distance from the strip that counts");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  using Cycle = std::vector<std::uint32_t>;  // each robot waits for the next, the last one for the first (lowest index)
  struct Event {
    std::int64_t from_ns, to_ns;
    Cycle cycle;
  };

  std::vector<std::uint32_t> wait_graph(const Sample& sample) const;
  std::uint32_t first_in_way(const Sample& sample, std::uint32_t robot) const;
  void close(const Cycle& cycle, std::int64_t from_ns, std::int64_t to_ns);

  ActiveSteps active_;
  std::vector<RecentProgress> progress_;  // by robot
  std::map<Cycle, std::int64_t> open_;    // begin of each cycle
  std::int64_t last_ns_ = 0;              // the last sample
  std::vector<Event> deadlocks_;          // cycles that lasted long enough
};

}  // namespace dmrp::metrics
