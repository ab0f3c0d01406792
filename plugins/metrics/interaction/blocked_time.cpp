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
      .summary("time without progress along the path")
      .source("own definition; waits that the plan demands count too")
      .value(
          "blocked_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
          "length of the union of all windows of window_s, after the robot first moved (|v| >= 0.01 m/s) and while it "
          "is active, in which it progressed by less than progress_m along its paths; undefined if planning failed");
}

void BlockedTime::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  robots_.assign(world().robots().size(), {});
  for (RobotProgress& robot : robots_) robot.progress.begin(std::llround(window_s * 1e9));
}

void BlockedTime::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    RobotProgress& state = robots_[robot];
    const RobotSample& now = sample.robots[robot];
    state.measured = true;
    state.started = state.started || speed_of(now) >= moving_speed;
    if (!state.started) continue;
    state.progress.observe(sample, now);
    if (state.progress.stalls(progress_m)) state.blocked.add(state.progress.since_ns(), sample.t_ns);
  }
}

void BlockedTime::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "blocked_time", values_of(robots_, [](const RobotProgress& state) {
              return state.measured ? in_seconds(state.blocked.value_ns()) : undefined;
            }));
}

}  // namespace dmrp::metrics
