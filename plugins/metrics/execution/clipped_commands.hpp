// SPDX-License-Identifier: MIT
// clipped_commands.hpp: how often a controller asked for more than the robot's drive can do.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class ClippedCommands final : public CountOfEvents {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.clipped_commands", "Clipped commands")
        .summary("commands that the robot's drive cannot execute")
        .source("own definition")
        .value("clipped_commands", "1", lower_is_better, system_and_robots,
               "number of commands that the host clipped: beyond the velocity limits or the ability of the drive "
               "(sideways, tighter than the steering allows); system: sum over robots; undefined if planning failed",
               never_negative);
  }

  void observe(const Sample& sample) override {
    for (const RobotEvent& event : sample.events)
      if (is(event, DMRP_ROBOT_EVENT_CLIPPED)) counts_[event.robot] += 1.0;
  }

  void finish(const TrialEnd&, MetricSink& sink) override { give_counts(sink, "clipped_commands", Severity::info); }
};

}  // namespace dmrp::metrics
