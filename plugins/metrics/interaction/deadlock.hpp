// SPDX-License-Identifier: MIT
// deadlock.hpp: cycles of robots that wait for each other: each is held or blocked by the next one, as the host's referee
// sees it. So each robot waits for at most one other, the members identify a cycle, and robots outside that wait for a
// member do not change it.
#pragma once

#include <cstdint>
#include <dmrp/plugin.hpp>
#include <map>
#include <vector>

#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

class Deadlock final : public Metric {
 public:
  static Descriptor describe();
  Param<double> lasting_s = param("lasting_s", 5.0)
                                .unit("s")
                                .range(0.0, 10000.0)
                                .doc("T: a cycle that lasts at least this long is a deadlock");

  void begin(const dmrp_plan* plan) override;
  void observe(const Sample& sample) override;
  void finish(const TrialEnd& end, MetricSink& sink) override;

 private:
  using Cycle = std::vector<std::uint32_t>;  // each robot waits for the next, the last one for the first (lowest index)
  struct Event {
    std::int64_t from_ns, to_ns;
    Cycle cycle;
  };

  std::vector<std::uint32_t> wait_graph() const;
  void close(const Cycle& cycle, std::int64_t from_ns, std::int64_t to_ns);

  RefereeClasses classes_;
  std::map<Cycle, std::int64_t> open_;  // begin of each cycle
  std::int64_t last_ns_ = 0;            // the last sample
  std::vector<Event> deadlocks_;        // cycles that lasted long enough
};

}  // namespace dmrp::metrics
