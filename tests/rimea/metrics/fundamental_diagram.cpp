// SPDX-License-Identifier: MIT
#include "tests/rimea/metrics/fundamental_diagram.hpp"

#include "tests/rimea/metrics/describe_rimea.hpp"

namespace dmrp::rimea {

Descriptor FundamentalDiagram::describe() {
  return describe_rimea("rimea.fundamental_diagram", "Fundamental diagram")
      .summary("density and speed of a crowd in a measurement area, by the classical method")
      .value("density", "1/m2", Direction::none, Subjects::system,
             "people in the area over its extent, mean over time (1/m where the extent is a length)")
      .value("walking_speed", "m/s", Direction::none, Subjects::system, "mean over time and the people in the area")
      .value("specific_flow", "1/(m s)", Direction::none, Subjects::system,
             "density times speed (1/s where the extent is a length)");
}

void FundamentalDiagram::begin(const dmrp::MetricTrial&) {
  area_ = rectangle_of(lower_m, upper_m);
  walking_speeds_.clear();
  intervals_ = people_ = speeds_ = speed_count_ = 0.0;
}

void FundamentalDiagram::observe(const Sample& sample) {
  if (!is_due(sample.t_ns, interval_s)) return;
  walking_speeds_.update(sample.people);
  if (seconds(sample.t_ns) <= from_s) return;
  ++intervals_;
  for (const Person& person : sample.people) {
    if (!toolkit::contains(area_, person.position)) continue;
    ++people_;
    const auto speed = walking_speeds_.speed(person, interval_s);
    if (!speed) continue;
    speeds_ += *speed;
    ++speed_count_;
  }
}

void FundamentalDiagram::finish(const TrialEnd&, MetricSink& sink) {
  const double density = intervals_ > 0.0 ? people_ / (intervals_ * extent) : undefined;
  const double speed = speed_count_ > 0.0 ? speeds_ / speed_count_ : undefined;
  sink.system("density", density);
  sink.system("walking_speed", speed);
  sink.system("specific_flow", density * speed);
}

}  // namespace dmrp::rimea
