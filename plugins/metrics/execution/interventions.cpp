// SPDX-License-Identifier: MIT
#include "metrics/execution/interventions.hpp"

#include <dmrp/robot_event.h>

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>
#include <string>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor Interventions::describe() {
  return describe_metric("dmrp.metric.interventions", "Interventions")
      .summary("how often and how long the collision monitor reduced commands ([navigation] of the experiment)")
      .source("own definition")
      .channels(DMRP_CHANNEL_RECOVERIES)
      .value("interventions", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of runs of control ticks at which the monitor reduced the robot's command; system: sum over "
             "robots; undefined if planning failed")
      .value("intervention_time", "s", Direction::lower_is_better, Subjects::system_and_robots,
             "time under reduced commands, from control tick to control tick; system: sum over robots; undefined if "
             "planning failed");
}

void Interventions::begin(const dmrp_plan* plan) {
  const std::size_t robots = world().robots().size();
  after_control_ = false;
  interventions_.clear();
  open_.assign(robots, -1);
  counts_.assign(robots, plan ? 0.0 : undefined);
}

// A sample tells what was commanded at the sample before it, if that was a control tick.
void Interventions::observe(const Sample& sample) {
  if (after_control_) {
    std::vector<bool> goes_on(open_.size(), false);
    for (const RobotEvent& event : sample.events) {
      if (event.kind != DMRP_ROBOT_EVENT_MONITOR || event.robot >= open_.size()) continue;
      intervene(event, toolkit::position(sample.robots[event.robot].pose));
      goes_on[event.robot] = true;
    }
    for (std::size_t robot = 0; robot < open_.size(); ++robot)
      if (!goes_on[robot]) open_[robot] = -1;
  }
  for (const std::int64_t index : open_)
    if (index >= 0) interventions_[static_cast<std::size_t>(index)].to_ns = sample.t_ns;
  after_control_ = sample.control_tick;
}

void Interventions::intervene(const RobotEvent& event, const Vec2& place) {
  if (open_[event.robot] < 0) {
    open_[event.robot] = static_cast<std::int64_t>(interventions_.size());
    interventions_.push_back({event.robot, event.t_ns, event.t_ns, event.detail, place});
  }
  std::uint32_t& least = interventions_[static_cast<std::size_t>(open_[event.robot])].least_percent;
  least = std::min(least, event.detail);
}

void Interventions::finish(const TrialEnd&, MetricSink& sink) {
  std::vector<std::int64_t> durations_ns(counts_.size(), 0);
  for (const Intervention& one : interventions_) {
    counts_[one.robot] += 1.0;
    durations_ns[one.robot] += one.to_ns - one.from_ns;
    sink.event({"interventions",
                one.from_ns,
                one.to_ns,
                {robot_subject(one.robot)},
                "the collision monitor leaves robot " + std::to_string(one.robot) + " " +
                    std::to_string(one.least_percent) + " % of its command",
                one.place,
                Severity::info});
  }
  std::vector<double> durations_s;
  for (std::size_t robot = 0; robot < counts_.size(); ++robot)
    durations_s.push_back(std::isnan(counts_[robot]) ? undefined : static_cast<double>(durations_ns[robot]) / 1e9);
  give(sink, "interventions", counts_, &sum_of_defined);
  give(sink, "intervention_time", durations_s, &sum_of_defined);
}

}  // namespace dmrp::metrics
