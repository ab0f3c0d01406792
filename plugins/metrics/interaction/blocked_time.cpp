// SPDX-License-Identifier: MIT
#include "metrics/interaction/blocked_time.hpp"

#include <cmath>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/in_seconds.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/speed_of.hpp"

namespace dmrp::metrics {
namespace {

constexpr double moving_speed = 0.01;  // m/s

}  // namespace

Descriptor BlockedTime::describe() {
  return describe_metric("dmrp.metric.blocked_time", "Blocked time")
      .summary("time in which a robot that has set out, and has not arrived, gains nothing along its path")
      .source("the benchmark's own; waits that the plan asks for count too")
      .value("blocked_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "length of the union of all windows of window_s, after the robot first moved (|v| >= 0.01 m/s) and while "
             "it is active, in which it gained less than progress_m along its paths; system: mean over robots; "
             "undefined if planning failed");
}

void BlockedTime::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  watched_.assign(world().robots().size(), {});
  for (Watched& watched : watched_) watched.progress.begin(std::llround(window_s * 1e9));
}

void BlockedTime::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < watched_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    Watched& watched = watched_[robot];
    const RobotSample& now = sample.robots[robot];
    watched.measured = true;
    watched.started = watched.started || speed_of(now) >= moving_speed;
    if (!watched.started) continue;
    watched.progress.observe(sample, now);
    if (watched.progress.stalls(progress_m)) watched.blocked.add(watched.progress.since_ns(), sample.t_ns);
  }
}

void BlockedTime::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "blocked_time", values_of(watched_, [](const Watched& watched) {
              return watched.measured ? in_seconds(watched.blocked.value_ns()) : undefined;
            }));
}

}  // namespace dmrp::metrics
