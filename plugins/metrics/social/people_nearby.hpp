// SPDX-License-Identifier: MIT
// people_nearby.hpp: the number of people around a robot.
#pragma once

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class PeopleNearby final : public ActiveTimeMetric<TimeCount> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.people_nearby", "People nearby")
        .summary("density of the crowd around the robots")
        .source("own definition")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value(
            "people_nearby", "1", Direction::none, system_and_robots,
            "mean over active time of the number of people within radius_m of the robot; undefined if planning failed",
            never_negative);
  }

  Param<double> radius_m =
      param("radius_m", 5.0).unit("m").range(0.0, 1000.0).doc("people at most this far away, centre to centre, count");

  void observe(const Sample& sample) override {
    sort_people(people_, sample);
    ActiveTimeMetric::observe(sample);
  }

  void finish(const TrialEnd&, MetricSink& sink) override { give_mean(sink, "people_nearby", &TimeCount::mean); }

 private:
  void add_step(TimeCount& near, std::size_t robot, const Sample& sample) override {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    const double squared_radius = radius_m * radius_m;
    std::int64_t count = 0;
    people_.visit(position, radius_m, [&](std::size_t person) {
      count += toolkit::squared_distance(position, sample.people[person].position) <= squared_radius;
    });
    near.add(count, sample.dt_ns);
  }

  toolkit::NeighbourGrid people_;  // at the sample
};

}  // namespace dmrp::metrics
