// SPDX-License-Identifier: MIT
#include "metrics/interaction/open_standstill.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor OpenStandstill::describe() {
  return describe_metric("dmrp.metric.open_standstill", "Standstill in the open")
      .summary("robots that stand although they may drive and nobody is in their way")
      .source("own definition: the class STUCK of dmrp/robot_event.h")
      .value("open_standstills", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "number of times that the referee saw the robot stuck, and not circling, for lasting_s or more: it gained "
             "less than 0.2 m in its last 20 s, no order holds it, and nobody is on the next metre of its course; "
             "system: sum over robots; undefined if planning failed, and in traces of hosts before the referee");
}

void OpenStandstill::begin(const dmrp_plan*) {
  classes_.begin(world().robots().size());
  measured_.assign(world().robots().size(), false);
  standing_.assign(world().robots().size(), {0, 0});
  standstills_.assign(world().robots().size(), {});
}

void OpenStandstill::observe(const Sample& sample) {
  classes_.observe(sample);
  for (std::size_t robot = 0; robot < standing_.size(); ++robot) {
    const auto now = classes_.in_step(robot);
    if (now) measured_[robot] = true;
    if (now && now->kind == DMRP_CLASS_STUCK && !now->circles)
      standing_[robot] = {now->since_ns, sample.t_ns};
    else
      close(robot);
  }
}

void OpenStandstill::close(std::size_t robot) {
  const Spell spell = std::exchange(standing_[robot], {0, 0});
  if (spell.to_ns > spell.from_ns && spell.to_ns - spell.from_ns >= std::llround(lasting_s * 1e9))
    standstills_[robot].push_back(spell);
}

void OpenStandstill::finish(const TrialEnd&, MetricSink& sink) {
  std::vector<double> counts;
  for (std::size_t robot = 0; robot < standing_.size(); ++robot) {
    close(robot);
    for (const Spell& spell : standstills_[robot])
      sink.event({"open_standstills",
                  spell.from_ns,
                  spell.to_ns,
                  {robot_subject(robot)},
                  "robot " + std::to_string(robot) + " stands although nobody is in its way"});
    counts.push_back(measured_[robot] ? static_cast<double>(standstills_[robot].size()) : undefined);
  }
  give(sink, "open_standstills", counts, &sum_of_defined);
}

}  // namespace dmrp::metrics
