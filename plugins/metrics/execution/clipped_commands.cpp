// SPDX-License-Identifier: MIT
#include "metrics/execution/clipped_commands.hpp"

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor ClippedCommands::describe() {
  return describe_metric("dmrp.metric.clipped_commands", "Clipped commands")
      .summary("commands that the robot's drive cannot execute")
      .source("own definition")
      .value("clipped_commands", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of commands that the host clipped: beyond the velocity limits or the ability of the drive "
             "(sideways, tighter than the steering allows); system: sum over robots; undefined if planning failed");
}

void ClippedCommands::begin(const dmrp_plan* plan) {
  counts_.assign(world().robots().size(), plan ? 0.0 : undefined);
}

void ClippedCommands::observe(const Sample& sample) {
  for (const RobotEvent& event : sample.events)
    if (event.kind == DMRP_ROBOT_EVENT_CLIPPED && event.robot < counts_.size()) counts_[event.robot] += 1.0;
}

void ClippedCommands::finish(const TrialEnd&, MetricSink& sink) {
  give(sink, "clipped_commands", counts_, &sum_of_defined);
}

}  // namespace dmrp::metrics
