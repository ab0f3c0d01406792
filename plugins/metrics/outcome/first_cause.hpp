// SPDX-License-Identifier: MIT
// first_cause.hpp: why robots failed, through all that waited for one another.
#pragma once

#include <map>

#include "metrics/measure/contact_ends.hpp"
#include "metrics/measure/referee_classes.hpp"
#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class FirstCause final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.first_cause", "First cause")
        .summary("why robots failed, and which robot was the cause")
        .source("own definition: the ends of robots in dmrp/trial_end.h, and their contacts")
        .value("first_cause", "1", Direction::none, system_and_robots,
               "of a robot that failed: why, 1 time limit (it still made progress), 2 circled and arrived where the "
               "experiment excludes that, 4 no command, 7 circling, 8 blocked by a person, 9 by a robot, 10 stuck; 100 "
               "collision, in place of 1 and 7 to 10, if a contact began while it was moving and lasted to its end, "
               "and of 7 to 10, if it never moved on; of a robot that is held behind another, the other's reason, or 6 "
               "if that has none; system: of most robots; undefined without a failure, if planning failed, and in "
               "traces of hosts before the referee")
        .value("culprit", "1", Direction::none, system_and_robots,
               "index of the robot that blocks the failed one or holds it, through all that wait; system: of most "
               "robots; undefined where nobody does")
        .value("held_behind", "1", lower_is_better, system_and_robots,
               "of a robot that failed: 1 if it is held behind another by the plan's order, else 0; system: sum over "
               "robots; undefined as first_cause")
        .value("after_standstill", "1", Direction::none, system_and_robots,
               "of a robot at a standstill that runs on to the time limit, as some do by chance: 1 if it arrived after "
               "all, else 0; system: mean over these robots; undefined without such a standstill");
  }

  void begin(const MetricTrial&) override {
    classes_.begin(world().robots().size());
    contacts_.begin(world().robots().size());
    runs_on_.assign(world().robots().size(), false);
  }

  void observe(const Sample& sample) override {
    classes_.observe(sample);
    contacts_.observe(sample);
    for (const RobotEvent& event : sample.events)
      if (event.kind == DMRP_ROBOT_EVENT_RUNS_ON && event.robot < runs_on_.size()) runs_on_[event.robot] = true;
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    std::vector<double> causes, culprits, held, after_standstill;
    for (std::size_t i = 0; i < end.robots.size(); ++i) {
      const RobotEnd& robot = end.robots[i];
      const bool failed = classes_.are_known() && robot.failure != DMRP_FAILURE_NONE;
      const bool is_held = robot.failure == DMRP_FAILURE_HELD_BEHIND;
      const bool has_culprit = robot.culprit < end.robots.size();
      const std::size_t first =
          is_held && has_culprit && end.robots[robot.culprit].failure != DMRP_FAILURE_NONE ? robot.culprit : i;
      causes.push_back(failed ? cause_of(first, end.robots[first]) : undefined);
      culprits.push_back(failed && has_culprit ? robot.culprit : undefined);
      held.push_back(failed ? is_held : undefined);
      after_standstill.push_back(runs_on_[i] ? robot.arrival_ns >= 0 : undefined);
    }
    give(sink, "first_cause", &most_frequent, causes);
    give(sink, "culprit", &most_frequent, culprits);
    give(sink, "held_behind", &sum_of_defined, held);
    give(sink, "after_standstill", &mean_of_defined, after_standstill);
  }

 private:
  static constexpr std::uint32_t collision = 100;  // no failure of the referee's

  // Failures are an open list.
  std::uint32_t cause_of(std::size_t robot, const RobotEnd& end) const {
    if (contacts_.failed_by_contact(robot, end)) return collision;
    return end.failure <= DMRP_FAILURE_STUCK ? end.failure : DMRP_FAILURE_TIMEOUT;
  }

  // The least of those that occur most often.
  static double most_frequent(const std::vector<double>& values) {
    std::map<double, int> counts;
    for (const double value : values)
      if (!std::isnan(value)) ++counts[value];
    const auto most = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? undefined : most->first;
  }

  RefereeClasses classes_;
  ContactEnds contacts_;
  std::vector<bool> runs_on_;  // by robot: it was at a standstill that ran on
};

}  // namespace dmrp::metrics
