// SPDX-License-Identifier: MIT
#include "metrics/social/people_nearby.hpp"

#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {

Descriptor PeopleNearby::describe() {
  return describe_metric("dmrp.metric.people_nearby", "People nearby")
      .summary("density of the crowd around the robots")
      .source("own definition")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value(
          "people_nearby", "1", Direction::none, Subjects::system_and_robots,
          "mean over active time of the number of people within radius_m of the robot; undefined if planning failed");
}

void PeopleNearby::begin(const dmrp_plan*) {
  near_.begin(world().robots().size());
}

void PeopleNearby::observe(const Sample& sample) {
  const double squared_radius = radius_m * radius_m;
  near_.observe(sample, [&](Vec2 position) {
    std::int64_t near = 0;
    for (const Person& person : sample.people)
      near += toolkit::squared_distance(position, person.position) <= squared_radius;
    return near;
  });
}

void PeopleNearby::finish(const TrialEnd&, MetricSink& sink) {
  give_mean(sink, "people_nearby", near_.means());
}

}  // namespace dmrp::metrics
