// SPDX-License-Identifier: MIT
// time_to_collision.hpp: the time until a robot would hit somebody if all kept their velocities.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

struct TimesToCollision {
  double least_s = undefined;
  TimeCount low;
};

class TimeToCollision final : public ActiveTimeMetric<TimesToCollision> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.time_to_collision", "Time to collision")
        .summary("time until a robot would touch another robot or a person at constant velocities")
        .source(
            "Hayward, Near-miss determination through use of a scale of danger, 1972; as in SocNavBench, Biswas et al. "
            "2022, with the radii of both")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value(
            "ttc_min", "s", higher_is_better, system_and_robots,
            "minimum over active time and over robots and people of the smallest tau > 0 with |dp + dv tau| = r + r'; "
            "0 in contact; system: minimum over robots; undefined where the robot is never on a collision course",
            never_negative)
        .value("ttc_low_time", "%", lower_is_better, system_and_robots,
               "share of active time in which a time to collision is below threshold_s; undefined without another "
               "robot or person",
               percent_range);
  }

  Param<double> threshold_s =
      param("threshold_s", 1.5).unit("s").range(0.0, 1000.0).doc("a time to collision below this is a conflict");

  void observe(const Sample& sample) override {
    robots_.clear();
    for (std::size_t robot = 0; robot < states_.size(); ++robot)
      robots_.push_back(moving(world().robots()[robot], sample.robots[robot]));
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_of_states(sink, "ttc_min", &least_of_defined, &TimesToCollision::least_s);
    give_mean(sink, "ttc_low_time", [](const TimesToCollision& times) { return times.low.percent(); });
  }

 private:
  void add_step(TimesToCollision& times, std::size_t robot, const Sample& sample) override {
    if (robots_.size() + sample.people.size() < 2) return;
    double soonest_s = undefined;
    for (std::size_t other = 0; other < robots_.size(); ++other)
      if (other != robot) soonest_s = std::fmin(soonest_s, time_to_contact(robots_[robot], robots_[other]));
    for (const Person& person : sample.people)
      soonest_s = std::fmin(soonest_s, time_to_contact(robots_[robot], moving(person)));
    times.least_s = std::fmin(times.least_s, soonest_s);
    times.low.add(soonest_s < threshold_s, sample.dt_ns);
  }

  std::vector<Moving> robots_;  // at the sample
};

}  // namespace dmrp::metrics
