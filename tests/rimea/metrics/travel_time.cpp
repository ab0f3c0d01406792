// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/travel_time.hpp"

#include <cmath>

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor TravelTime::describe() {
  return describe_rimea("rimea.travel_time", "Travel time")
      .summary("time that people take from one line across their way to another")
      .value("travel_time", "s", Direction::none, Subjects::system_and_pedestrians,
             "from the line x = from_x_m to the line x = to_x_m; system: the mean of all who crossed both");
}

void TravelTime::begin(const dmrp::MetricTrial&) {
  walks_.clear();
}

void TravelTime::observe(const Sample& sample) {
  const double t_s = seconds(sample.t_ns);
  for (const Person& person : sample.people) {
    const auto [found, is_new] = walks_.try_emplace(person.id, Walk{person.position.x, t_s, undefined, undefined});
    Walk& walk = found->second;
    // linear motion between two samples
    const auto crossing_s = [&](double line_m) {
      const double share = (line_m - walk.last_x_m) / (person.position.x - walk.last_x_m);
      return walk.last_t_s + share * (t_s - walk.last_t_s);
    };
    const auto crosses = [&](double line_m) { return walk.last_x_m < line_m && person.position.x >= line_m; };
    if (std::isnan(walk.from_s) && crosses(from_x_m)) walk.from_s = crossing_s(from_x_m);
    if (std::isnan(walk.to_s) && crosses(to_x_m)) walk.to_s = crossing_s(to_x_m);
    walk.last_x_m = person.position.x;
    walk.last_t_s = t_s;
  }
}

void TravelTime::finish(const TrialEnd&, MetricSink& sink) {
  double sum_s = 0.0;
  double count = 0.0;
  for (const auto& [id, walk] : walks_) {
    const double time_s = walk.to_s - walk.from_s;
    sink.pedestrian("travel_time", id, time_s);
    if (std::isnan(time_s)) continue;
    sum_s += time_s;
    ++count;
  }
  sink.system("travel_time", count > 0.0 ? sum_s / count : undefined);
}

}  // namespace dmrp::rimea
