// SPDX-License-Identifier: MIT
#include "metrics/safety/time_to_collision.hpp"

#include <cmath>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor TimeToCollision::describe() {
  return describe_metric("dmrp.metric.time_to_collision", "Time to collision")
      .summary("time until a robot would touch another robot or a person at constant velocities")
      .source(
          "Hayward, Near-miss determination through use of a scale of danger, 1972; as in SocNavBench, Biswas et al. "
          "2022, with the radii of both")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("ttc_min", "s", Direction::higher_is_better, Subjects::system_and_robots,
             "minimum over active time and over robots and people of the smallest tau > 0 with |dp + dv tau| = r + r'; "
             "0 in contact; system: minimum over robots; undefined where the robot is never on a collision course")
      .value("ttc_low_time", "%", Direction::lower_is_better, Subjects::system_and_robots,
             "share of active time in which a time to collision is below threshold_s; undefined without another robot "
             "or person");
}

void TimeToCollision::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  times_.assign(world().robots().size(), {});
}

void TimeToCollision::observe(const Sample& sample) {
  active_.observe(sample);
  robots_.clear();
  for (std::size_t robot = 0; robot < times_.size(); ++robot)
    robots_.push_back(moving(world().robots()[robot], sample.robots[robot]));
  if (robots_.size() + sample.people.size() < 2) return;
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    double soonest_s = undefined;
    for (std::size_t other = 0; other < robots_.size(); ++other)
      if (other != robot) soonest_s = std::fmin(soonest_s, time_to_contact(robots_[robot], robots_[other]));
    for (const Person& person : sample.people)
      soonest_s = std::fmin(soonest_s, time_to_contact(robots_[robot], moving(person)));
    times_[robot].least_s = std::fmin(times_[robot].least_s, soonest_s);
    times_[robot].below.add(soonest_s < threshold_s, sample.dt_ns);
  }
}

void TimeToCollision::finish(const TrialEnd&, MetricSink& sink) {
  give(sink, "ttc_min", values_of(times_, [](const Times& times) { return times.least_s; }), &least_of_defined);
  give_mean(sink, "ttc_low_time", values_of(times_, [](const Times& times) { return times.below.percent(); }));
}

}  // namespace dmrp::metrics
