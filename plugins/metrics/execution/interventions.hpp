// SPDX-License-Identifier: MIT
// interventions.hpp: how often and for how long the collision monitor reduced robots' commands.
#pragma once

#include <dmrp/robot_event.h>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class Interventions final : public CountOfEvents {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.interventions", "Interventions")
        .summary("how often and how long the collision monitor reduced commands ([navigation] of the experiment)")
        .source("own definition")
        .channels(DMRP_CHANNEL_RECOVERIES)
        .value("interventions", "1", lower_is_better, system_and_robots,
               "number of runs of control ticks at which the monitor reduced the robot's command; system: sum over "
               "robots; undefined if planning failed",
               never_negative)
        .value("intervention_time", "s", lower_is_better, system_and_robots,
               "time under reduced commands, from control tick to control tick; system: sum over robots; undefined if "
               "planning failed",
               never_negative);
  }

  void begin(const MetricTrial& trial) override {
    CountOfEvents::begin(trial);
    after_control_ = false;
    least_percent_.assign(counts_.size(), 0);
  }

  // A sample tells what was commanded at the sample before it, if that was a control tick.
  void observe(const Sample& sample) override {
    if (after_control_) {
      std::vector<bool> goes_on(counts_.size(), false);
      for (const RobotEvent& event : sample.events) {
        if (!is(event, DMRP_ROBOT_EVENT_MONITOR)) continue;
        intervene(event, sample);
        goes_on[event.robot] = true;
      }
      for (std::size_t robot = 0; robot < counts_.size(); ++robot)
        if (!goes_on[robot]) end_spell(robot);
    }
    for (std::size_t robot = 0; robot < counts_.size(); ++robot)
      if (RobotSpell* const spell = open_spell(robot)) spell->time.to_ns = sample.t_ns;
    after_control_ = sample.control_tick;
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    std::vector<std::int64_t> durations_ns(counts_.size(), 0);
    for (const RobotSpell& spell : spells_) durations_ns[spell.robot] += spell.time.to_ns - spell.time.from_ns;
    std::vector<double> durations_s;
    for (std::size_t robot = 0; robot < counts_.size(); ++robot)
      durations_s.push_back(std::isnan(counts_[robot]) ? undefined : in_seconds(durations_ns[robot]));
    give_counts(sink, "interventions", Severity::info);
    give(sink, "intervention_time", &sum_of_defined, durations_s);
  }

 private:
  void intervene(const RobotEvent& event, const Sample& sample) {
    std::uint32_t& least = least_percent_[event.robot];
    if (!open_spell(event.robot)) {
      begin_spell(event, sample, "");
      least = event.detail;
    }
    least = std::min(least, event.detail);
    open_spell(event.robot)->text = "the collision monitor leaves robot " + std::to_string(event.robot) + " " +
                                    std::to_string(least) + " % of its command";
  }

  bool after_control_ = false;                // the last sample was a control tick
  std::vector<std::uint32_t> least_percent_;  // by robot: that its spell left of a command
};

}  // namespace dmrp::metrics
