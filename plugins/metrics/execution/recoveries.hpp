// SPDX-License-Identifier: MIT
// recoveries.hpp: how often robots went through a recovery, and by which steps.
#pragma once

#include <dmrp/robot_event.h>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class Recoveries final : public CountOfEvents {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.recoveries", "Recoveries")
        .summary("how often robots recovered ([recovery] of the experiment)")
        .source("own definition")
        .channels(DMRP_CHANNEL_RECOVERIES)
        .value("recoveries", "1", lower_is_better, system_and_robots,
               "number of recoveries; system: sum over robots; undefined if planning failed", never_negative);
  }

  void observe(const Sample& sample) override {
    for (const RobotEvent& event : sample.events) {
      if (!is(event, DMRP_ROBOT_EVENT_RECOVERY)) continue;
      if (event.detail == DMRP_RECOVERY_NONE)
        close(event.robot, event.t_ns);
      else if (RobotSpell* const recovery = open_spell(event.robot))
        recovery->text += ", " + name_of(event.detail);
      else
        begin_spell(event, sample, "robot " + std::to_string(event.robot) + " recovers: " + name_of(event.detail));
    }
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    for (std::size_t robot = 0; robot < counts_.size(); ++robot) close(robot, end.t_ns);
    give_counts(sink, "recoveries", Severity::warning);
  }

 private:
  static std::string name_of(std::uint32_t step) {
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

  void close(std::size_t robot, std::int64_t now_ns) {
    if (RobotSpell* const recovery = open_spell(robot)) recovery->time.to_ns = now_ns;
    end_spell(robot);
  }
};

}  // namespace dmrp::metrics
