// SPDX-License-Identifier: MIT
// blocked_time.hpp: the time in which robots make no progress, by its cause.
#pragma once

#include <dmrp/robot_event.h>

#include <array>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/referee_classes.hpp"

namespace dmrp::metrics {

struct BlockedTimes {
  bool measured = false;                                   // was active in at least one step
  std::array<std::int64_t, DMRP_CLASS_STUCK + 1> ns = {};  // by class
  std::int64_t circling_ns = 0;

  double seconds(std::int64_t part_ns) const { return measured ? in_seconds(part_ns) : undefined; }
  double held_s() const { return seconds(ns[DMRP_CLASS_HELD]); }
  double by_person_s() const { return seconds(ns[DMRP_CLASS_BLOCKED_PERSON]); }
  double by_robot_s() const { return seconds(ns[DMRP_CLASS_BLOCKED_ROBOT]); }
  double stuck_s() const { return seconds(ns[DMRP_CLASS_STUCK]); }
  double circling_s() const { return seconds(circling_ns); }
  double blocked_s() const {
    return seconds(ns[DMRP_CLASS_BLOCKED_PERSON] + ns[DMRP_CLASS_BLOCKED_ROBOT] + ns[DMRP_CLASS_STUCK]);
  }
};

class BlockedTime final : public RobotMetric<BlockedTimes> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.blocked_time", "Blocked time")
        .summary("time without progress, by its cause, as the host's referee sees it")
        .source("own definition: sums over the classes of dmrp/robot_event.h")
        .value("blocked_time", "s", lower_is_better, system_and_robots,
               "active time of a robot that may drive and gained less than 0.2 m in its last 20 s: the sum of the next "
               "three; undefined if planning failed, as all of these, and in traces of hosts before the referee",
               never_negative)
        .value("blocked_time_person", "s", lower_is_better, system_and_robots,
               "of this, with a person first on the next metre of its course", never_negative)
        .value("blocked_time_robot", "s", lower_is_better, system_and_robots, "of this, with a robot first there",
               never_negative)
        .value("blocked_time_stuck", "s", lower_is_better, system_and_robots, "of this, with nobody there",
               never_negative)
        .value("held_time", "s", lower_is_better, system_and_robots,
               "active time in which the plan's order lets the robot wait for another (execution = \"ordered\")",
               never_negative)
        .value("circling_time", "s", lower_is_better, system_and_robots,
               "blocked time in which the robot travelled over 1 m or turned over 4 pi in its last 20 s",
               never_negative);
  }

  void begin(const MetricTrial& trial) override {
    RobotMetric::begin(trial);
    classes_.begin(states_.size());
  }

  void observe(const Sample& sample) override {
    classes_.observe(sample);
    for (std::size_t robot = 0; robot < states_.size(); ++robot) {
      const auto now = classes_.in_step(robot);
      if (!now) continue;
      BlockedTimes& times = states_[robot];
      times.measured = true;
      if (now->kind < times.ns.size()) times.ns[now->kind] += sample.dt_ns;
      if (now->circles) times.circling_ns += sample.dt_ns;
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "blocked_time", &BlockedTimes::blocked_s);
    give_mean(sink, "blocked_time_person", &BlockedTimes::by_person_s);
    give_mean(sink, "blocked_time_robot", &BlockedTimes::by_robot_s);
    give_mean(sink, "blocked_time_stuck", &BlockedTimes::stuck_s);
    give_mean(sink, "held_time", &BlockedTimes::held_s);
    give_mean(sink, "circling_time", &BlockedTimes::circling_s);
  }

 private:
  RefereeClasses classes_;
};

}  // namespace dmrp::metrics
