// SPDX-License-Identifier: MIT
// deadlock.hpp: robots that wait for each other in a circle.
//
// A robot waits for another if it gains nothing along its path and the other is the first robot that
// stands in its way: within `margin_m` of the strip that its body would sweep from where it is to its place on its path
// and on along it for `look_ahead_m`. So each robot waits for one at most, a circle of waiting robots is told by its
// members, and whoever waits for a circle from outside does not change it.
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
                                .doc("T: a circle that lasts at least this long is a deadlock");
  Param<double> window_s =
      param("window_s", 2.0).unit("s").range(0.001, 1000.0).doc("time without progress after which a robot waits");
  Param<double> progress_m = param("progress_m", 0.1)
                                 .unit("m")
                                 .range(0.0, 100.0)
                                 .doc("gaining less than this along the path in a window is no progress");
  Param<double> look_ahead_m =
      param("look_ahead_m", 1.0).unit("m").range(0.0, 100.0).doc("how far along its path somebody stands in its way");
  Param<double> margin_m = param("margin_m", 0.1)
                               .unit("m")
                               .range(0.0, 100.0)
                               .doc("who is this near to the strip that the body sweeps stands in the way");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  using Circle = std::vector<std::uint32_t>;  // each waits for the next, the last for the first: the lowest index
  struct Lasting {
    std::int64_t from_ns, to_ns;
    Circle circle;
  };

  std::vector<std::uint32_t> who_waits_for_whom(const Sample& sample) const;
  std::uint32_t first_in_way(const Sample& sample, std::uint32_t robot) const;
  void close(const Circle& circle, std::int64_t from_ns, std::int64_t to_ns);

  ActiveSteps active_;
  std::vector<RecentProgress> progress_;  // a robot
  std::map<Circle, std::int64_t> open_;   // since when
  std::int64_t last_ns_ = 0;              // the last sample
  std::vector<Lasting> deadlocks_;        // those that lasted
};

}  // namespace dmrp::metrics
