// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/bottleneck.hpp"

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor Bottleneck::describe() {
  return describe_rimea("rimea.bottleneck", "Bottleneck")
      .summary("density and speed of a crowd before and behind a bottleneck")
      .value("density_before", "1/m2", Direction::none, Subjects::system, "in the area before the bottleneck")
      .value("speed_before", "m/s", Direction::none, Subjects::system, "of the people there")
      .value("density_behind", "1/m2", Direction::none, Subjects::system, "in the area behind it")
      .value("speed_behind", "m/s", Direction::none, Subjects::system, "of the people there")
      .value("density_at_exit", "1/m2", Direction::none, Subjects::system, "in the area before the exit")
      .value("speed_at_exit", "m/s", Direction::none, Subjects::system, "of the people there")
      .value("bottleneck_flow", "1/(m s)", Direction::none, Subjects::system,
             "people who pass the bottleneck per second and metre of its width");
}

void Bottleneck::begin(const dmrp::MetricTrial&) {
  before_ = rectangle_of(before_lower_m, before_upper_m);
  behind_ = rectangle_of(behind_lower_m, behind_upper_m);
  exit_ = rectangle_of(exit_lower_m, exit_upper_m);
  walking_speeds_.clear();
  people_ = 0;
  passed_.clear();
  intervals_.clear();
}

void Bottleneck::observe(const Sample& sample) {
  if (sample.dt_ns == 0) people_ = sample.people.size();
  for (const Person& person : sample.people)
    if (person.position.x >= line_x_m) passed_.insert(person.id);
  if (!is_due(sample.t_ns, interval_s)) return;
  walking_speeds_.update(sample.people);
  intervals_.push_back({seconds(sample.t_ns), passed_.size(), presence_in(before_, sample.people),
                        presence_in(behind_, sample.people), presence_in(exit_, sample.people)});
}

void Bottleneck::finish(const TrialEnd&, MetricSink& sink) {
  Presence before;
  Presence behind;
  Presence exit;
  double count = 0.0;
  const Interval* first = nullptr;
  const Interval* last = nullptr;
  for (const Interval& interval : intervals_) {
    if (10 * interval.passed < people_ || 10 * interval.passed > 8 * people_) continue;
    if (!first) first = &interval;
    last = &interval;
    before.add(interval.before);
    behind.add(interval.behind);
    exit.add(interval.exit);
    ++count;
  }
  sink.system("density_before", before.density(before_, count));
  sink.system("speed_before", before.mean_speed());
  sink.system("density_behind", behind.density(behind_, count));
  sink.system("speed_behind", behind.mean_speed());
  sink.system("density_at_exit", exit.density(exit_, count));
  sink.system("speed_at_exit", exit.mean_speed());
  sink.system("bottleneck_flow",
              count > 1.0 ? static_cast<double>(last->passed - first->passed) / ((last->t_s - first->t_s) * width_m)
                          : undefined);
}

Bottleneck::Presence Bottleneck::presence_in(const toolkit::Rectangle& area, const Span<Person>& people) const {
  Presence presence;
  for (const Person& person : people) {
    if (!toolkit::contains(area, person.position)) continue;
    ++presence.people;
    if (const auto speed = walking_speeds_.speed(person, interval_s)) {
      presence.speeds += *speed;
      ++presence.speed_count;
    }
  }
  return presence;
}

void Bottleneck::Presence::add(const Presence& other) {
  people += other.people;
  speeds += other.speeds;
  speed_count += other.speed_count;
}

double Bottleneck::Presence::density(const toolkit::Rectangle& area, double intervals) const {
  const double extent_m2 = (area.upper.x - area.lower.x) * (area.upper.y - area.lower.y);
  return intervals > 0.0 ? people / (intervals * extent_m2) : undefined;
}

double Bottleneck::Presence::mean_speed() const {
  return speed_count > 0.0 ? speeds / speed_count : undefined;
}

}  // namespace dmrp::rimea
