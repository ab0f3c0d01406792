// SPDX-License-Identifier: MIT
#include "people_nearby.hpp"

#include <dmrp/toolkit/vec2.hpp>

#include "../measure/describe_metric.hpp"
#include "../measure/sums.hpp"

namespace dmrp::metrics {

Descriptor PeopleNearby::describe() {
  return describe_metric("dmrp.metric.people_nearby", "People nearby")
      .summary("how dense the crowd was that the robots met")
      .source("the benchmark's own, so that density is known beside every other value")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value(
          "people_nearby", "1", Direction::none, Subjects::system_and_robots,
          "mean over its active time of the number of people within radius_m of the robot; system: mean over robots; "
          "undefined if planning failed");
}

void PeopleNearby::begin(const dmrp_plan*) {
  active_.begin(world().robots().size());
  times_.assign(world().robots().size(), {});
}

void PeopleNearby::observe(const Sample& sample) {
  active_.observe(sample);
  const double squared_radius = radius_m * radius_m;
  for (std::size_t robot = 0; robot < times_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    std::int64_t people = 0;
    for (const Person& person : sample.people)
      people += toolkit::squared_distance(position, person.position) <= squared_radius;
    times_[robot].active_ns += sample.dt_ns;
    times_[robot].person_ns += people * sample.dt_ns;
  }
}

void PeopleNearby::finish(const TrialEnd&, MetricSink& sink) {
  std::vector<double> means;
  for (std::size_t robot = 0; robot < times_.size(); ++robot) {
    const Times& times = times_[robot];
    means.push_back(times.active_ns > 0 ? static_cast<double>(times.person_ns) / static_cast<double>(times.active_ns)
                                        : undefined);
    sink.robot("people_nearby", robot, means.back());
  }
  sink.system("people_nearby", mean_of_defined(means));
}

}  // namespace dmrp::metrics
