// SPDX-License-Identifier: MIT
#include "metrics/interaction/blocked_time.hpp"

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor BlockedTime::describe() {
  const auto lower = Direction::lower_is_better;
  const auto both = Subjects::system_and_robots;
  return describe_metric("dmrp.metric.blocked_time", "Blocked time")
      .summary("time without progress, by its cause, as the host's referee sees it")
      .source("own definition: sums over the classes of dmrp/robot_event.h")
      .value("blocked_time", "s", lower, both,
             "active time of a robot that may drive and gained less than 0.2 m in its last 20 s: the sum of the next "
             "three; undefined if planning failed, as all of these, and in traces of hosts before the referee")
      .value("blocked_time_person", "s", lower, both, "of this, with a person first on the next metre of its course")
      .value("blocked_time_robot", "s", lower, both, "of this, with a robot first there")
      .value("blocked_time_stuck", "s", lower, both, "of this, with nobody there")
      .value("held_time", "s", lower, both,
             "active time in which the plan's order lets the robot wait for another (execution = \"ordered\")")
      .value("circling_time", "s", lower, both,
             "blocked time in which the robot travelled over 1 m or turned over 4 pi in its last 20 s");
}

void BlockedTime::begin(const dmrp_plan*) {
  classes_.begin(world().robots().size());
  times_.assign(world().robots().size(), {});
}

void BlockedTime::observe(const Sample& sample) {
  classes_.observe(sample);
  for (std::size_t robot = 0; robot < times_.size(); ++robot) {
    const auto now = classes_.in_step(robot);
    if (!now) continue;
    Times& times = times_[robot];
    times.measured = true;
    if (now->kind < times.ns.size()) times.ns[now->kind] += sample.dt_ns;
    if (now->circles) times.circling_ns += sample.dt_ns;
  }
}

void BlockedTime::finish(const TrialEnd&, MetricSink& sink) {
  const auto give_time = [&](const char* name, auto&& ns_of) {
    give_mean(sink, name, values_of(times_, [&](const Times& times) {
                return times.measured ? in_seconds(ns_of(times)) : undefined;
              }));
  };
  give_time("blocked_time", [](const Times& times) {
    return times.ns[DMRP_CLASS_BLOCKED_PERSON] + times.ns[DMRP_CLASS_BLOCKED_ROBOT] + times.ns[DMRP_CLASS_STUCK];
  });
  give_time("blocked_time_person", [](const Times& times) { return times.ns[DMRP_CLASS_BLOCKED_PERSON]; });
  give_time("blocked_time_robot", [](const Times& times) { return times.ns[DMRP_CLASS_BLOCKED_ROBOT]; });
  give_time("blocked_time_stuck", [](const Times& times) { return times.ns[DMRP_CLASS_STUCK]; });
  give_time("held_time", [](const Times& times) { return times.ns[DMRP_CLASS_HELD]; });
  give_time("circling_time", [](const Times& times) { return times.circling_ns; });
}

}  // namespace dmrp::metrics
