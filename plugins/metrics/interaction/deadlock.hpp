// SPDX-License-Identifier: MIT
// deadlock.hpp: cycles of robots that wait for each other: each is held or blocked by the next one, as the host's referee
// sees it. So each robot waits for at most one other, the members identify a cycle, and robots outside that wait for a
// member do not change it.
#pragma once

#include <map>
#include <tuple>

#include "metrics/measure/referee_classes.hpp"
#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class Deadlock final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.deadlock", "Deadlock")
        .summary("robots that wait for each other in a lasting cycle")
        .source("own definition; cycles of the wait-for graph as in Coffman et al., System Deadlocks, 1971")
        .value("deadlocks", "1", lower_is_better, system_and_robots,
               "number of cycles of robots, each held or blocked by the next one for the host's referee "
               "(dmrp/robot_event.h), that last at least lasting_s; robot: its cycles; undefined if planning failed, "
               "and in traces of hosts before the referee",
               never_negative)
        .value("deadlock_time", "s", lower_is_better, system_and_robots,
               "length of the union of these cycles; robot: of its cycles; undefined as deadlocks", never_negative);
  }

  Param<double> lasting_s = param("lasting_s", 5.0)
                                .unit("s")
                                .range(0.0, 10000.0)
                                .doc("T: a cycle that lasts at least this long is a deadlock");

  void begin(const MetricTrial&) override {
    classes_.begin(world().robots().size());
    open_.clear();
    last_ns_ = -1;
    deadlocks_.clear();
  }

  void observe(const Sample& sample) override {
    classes_.observe(sample);
    std::map<Cycle, std::int64_t> now;
    for (const Cycle& cycle : find_cycles(wait_graph())) {
      const auto before = open_.find(cycle);
      now[cycle] = before != open_.end() ? before->second : sample.t_ns - sample.dt_ns;
    }
    for (const auto& [cycle, from_ns] : open_)
      if (now.count(cycle) == 0) close(cycle, from_ns, last_ns_);
    open_.swap(now);
    last_ns_ = sample.t_ns;
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    for (const auto& [cycle, from_ns] : open_) close(cycle, from_ns, last_ns_);
    std::sort(deadlocks_.begin(), deadlocks_.end(), [](const Lasting& a, const Lasting& b) {
      return std::tie(a.time.from_ns, a.cycle) < std::tie(b.time.from_ns, b.cycle);
    });

    UnionLength all;
    std::vector<UnionLength> own(world().robots().size());
    std::vector<double> counts(own.size(), 0.0);
    for (const auto& [time, cycle] : deadlocks_) {
      all.add(time.from_ns, time.to_ns);
      std::string text = "robots ";
      for (const std::uint32_t robot : cycle) {
        own[robot].add(time.from_ns, time.to_ns);
        ++counts[robot];
        text += std::to_string(robot) + " -> ";
      }
      text += std::to_string(cycle.front()) + " wait for each other";
      give_event(sink, "deadlocks", time, cycle, text);
    }
    const bool measured = classes_.are_known();
    for (std::size_t robot = 0; robot < own.size(); ++robot) {
      sink.robot("deadlocks", robot, measured ? counts[robot] : undefined);
      sink.robot("deadlock_time", robot, measured ? in_seconds(own[robot].value_ns()) : undefined);
    }
    sink.system("deadlocks", measured ? static_cast<double>(deadlocks_.size()) : undefined);
    sink.system("deadlock_time", measured ? in_seconds(all.value_ns()) : undefined);
  }

 private:
  using Cycle = std::vector<std::uint32_t>;  // each robot waits for the next, the last one for the first (lowest index)
  struct Lasting {
    Spell time;
    Cycle cycle;
  };

  // The cycles of a graph with at most one edge from each node. Each begins with its lowest index; ordered by that.
  static std::vector<Cycle> find_cycles(const std::vector<std::uint32_t>& waits_for) {
    std::vector<Cycle> cycles;
    std::vector<std::uint32_t> seen_from(waits_for.size(), DMRP_NOBODY);
    for (std::uint32_t first = 0; first < waits_for.size(); ++first) {
      std::uint32_t at = first;
      while (at != DMRP_NOBODY && seen_from[at] == DMRP_NOBODY) {
        seen_from[at] = first;
        at = waits_for[at];
      }
      if (at == DMRP_NOBODY || seen_from[at] != first) continue;
      // `at` lies on a new cycle
      Cycle cycle = {at};
      for (std::uint32_t next = waits_for[at]; next != at; next = waits_for[next]) cycle.push_back(next);
      std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
      cycles.push_back(cycle);
    }
    return cycles;
  }

  std::vector<std::uint32_t> wait_graph() const {
    std::vector<std::uint32_t> waits_for(world().robots().size(), DMRP_NOBODY);
    for (std::size_t robot = 0; robot < waits_for.size(); ++robot) {
      const auto now = classes_.in_step(robot);
      const bool waits = now && (now->kind == DMRP_CLASS_HELD || now->kind == DMRP_CLASS_BLOCKED_ROBOT);
      if (waits && now->other < waits_for.size()) waits_for[robot] = now->other;
    }
    return waits_for;
  }

  void close(const Cycle& cycle, std::int64_t from_ns, std::int64_t to_ns) {
    if (to_ns - from_ns >= std::llround(lasting_s * 1e9)) deadlocks_.push_back({{from_ns, to_ns}, cycle});
  }

  RefereeClasses classes_;
  std::map<Cycle, std::int64_t> open_;  // begin of each cycle
  std::int64_t last_ns_ = 0;            // the last sample
  std::vector<Lasting> deadlocks_;      // cycles that lasted long enough
};

}  // namespace dmrp::metrics
