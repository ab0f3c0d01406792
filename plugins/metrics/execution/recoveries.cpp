// SPDX-License-Identifier: MIT
#include "metrics/execution/recoveries.hpp"

#include <dmrp/robot_event.h>

#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

std::string name_of(std::uint32_t step) {
  switch (step) {
    case DMRP_RECOVERY_CLEAR_COSTMAP:
      return "clear_costmap";
    case DMRP_RECOVERY_SPIN:
      return "spin";
    case DMRP_RECOVERY_WAIT:
      return "wait";
    case DMRP_RECOVERY_BACKUP:
      return "backup";
    case DMRP_RECOVERY_REPLAN:
      return "replan";
    default:
      return "step " + std::to_string(step);
  }
}

}  // namespace

Descriptor Recoveries::describe() {
  return describe_metric("dmrp.metric.recoveries", "Recoveries")
      .summary("how often robots recovered ([recovery] of the experiment)")
      .source("own definition")
      .channels(DMRP_CHANNEL_RECOVERIES)
      .value("recoveries", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of recoveries; system: sum over robots; undefined if planning failed");
}

void Recoveries::begin(const dmrp_plan* plan) {
  recoveries_.clear();
  open_.assign(world().robots().size(), -1);
  counts_.assign(world().robots().size(), plan ? 0.0 : undefined);
}

void Recoveries::observe(const Sample& sample) {
  for (const RobotEvent& event : sample.events) {
    if (event.kind != DMRP_ROBOT_EVENT_RECOVERY || event.robot >= open_.size()) continue;
    if (event.detail == DMRP_RECOVERY_NONE) {
      close(event.robot, event.t_ns);
    } else if (open_[event.robot] >= 0) {
      recoveries_[static_cast<std::size_t>(open_[event.robot])].steps += ", " + name_of(event.detail);
    } else {
      open_[event.robot] = static_cast<std::int64_t>(recoveries_.size());
      recoveries_.push_back({event.robot, event.t_ns, event.t_ns, name_of(event.detail),
                             toolkit::position(sample.robots[event.robot].pose)});
      counts_[event.robot] += 1.0;
    }
  }
}

void Recoveries::close(std::size_t robot, std::int64_t now_ns) {
  if (open_[robot] >= 0) recoveries_[static_cast<std::size_t>(open_[robot])].to_ns = now_ns;
  open_[robot] = -1;
}

void Recoveries::finish(const TrialEnd& end, MetricSink& sink) {
  for (std::size_t robot = 0; robot < open_.size(); ++robot) close(robot, end.t_ns);
  for (const Recovery& recovery : recoveries_)
    sink.event({"recoveries",
                recovery.from_ns,
                recovery.to_ns,
                {robot_subject(recovery.robot)},
                "robot " + std::to_string(recovery.robot) + " recovers: " + recovery.steps,
                recovery.place,
                Severity::warning});
  give(sink, "recoveries", counts_, &sum_of_defined);
}

}  // namespace dmrp::metrics
