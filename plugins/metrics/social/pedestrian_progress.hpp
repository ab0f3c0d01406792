// SPDX-License-Identifier: MIT
// pedestrian_progress.hpp: the progress of a crowd toward its targets, as a curve over time.
//
// Made for pairs of trials: the same crowd with and without robots, compared at equal times. Every person walks legs,
// each from its first position to a target rectangle. A finished leg counts with its full straight distance, whatever
// the walked way; the current one counts with this distance minus the remaining one. So the sum does not jump when a
// target changes, and a detour appears as missing progress, not as walked distance.
#pragma once

#include <dmrp/toolkit/rectangle.hpp>
#include <map>

#include "metrics/measure/values.hpp"

namespace dmrp::metrics {

class PedestrianProgress final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.pedestrian_progress", "Pedestrian progress")
        .summary("progress of people toward their targets over time, and their speeds")
        .source("own definition, for comparing a crowd with and without robots")
        .channels(DMRP_CHANNEL_PEOPLE)
        .value("pedestrian_progress", "m", higher_is_better, Subjects::system,
               "over time t = 0, 1, 2, ... s: (1/n) sum over all people of the progress until t, n the number of "
               "people in the world at once; a finished leg counts with its straight length to the target area, the "
               "current one with what is done of it; undefined without people")
        .curve()
        .value("pedestrian_speed", "m/s", higher_is_better, Subjects::system,
               "mean of |v| over time and present people; undefined without people", never_negative)
        .value("pedestrian_desired_speed", "m/s", Direction::none, Subjects::system,
               "mean of the desired speed over time and present people; undefined without people", never_negative);
  }

  void begin(const MetricTrial&) override {
    legs_.clear();
    finished_m_ = {};
    most_people_ = 0;
    gained_m_.clear();
    speed_ = {};
    desired_speed_ = {};
  }

  void observe(const Sample& sample) override {
    update_legs(sample);
    most_people_ = std::max(most_people_, sample.people.size());
    for (const Person& person : sample.people) {
      speed_.add(toolkit::norm(person.velocity), sample.dt_ns);
      desired_speed_.add(person.desired_speed, sample.dt_ns);
    }
    // an instant between two samples belongs to the step that contains it
    while (static_cast<std::int64_t>(gained_m_.size()) * sample_period_ns <= sample.t_ns)
      gained_m_.push_back(gained_m());
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    const std::size_t people = std::max<std::size_t>(world()->person_count, most_people_);
    if (most_people_ == 0) {
      sink.curve("pedestrian_progress", 0.0, undefined);
    } else {
      for (std::size_t second = 0; second < gained_m_.size(); ++second)
        sink.curve("pedestrian_progress", static_cast<double>(second), gained_m_[second] / static_cast<double>(people));
    }
    sink.system("pedestrian_speed", speed_.mean());
    sink.system("pedestrian_desired_speed", desired_speed_.mean());
  }

 private:
  static constexpr std::int64_t sample_period_ns = 1'000'000'000;

  static double distance_to_target(const Person& person) {
    return toolkit::distance(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position);
  }

  struct Leg {
    std::uint64_t person_id;
    Vec2 lower, upper;  // the target
    double whole_m;     // from the first position to the target
    double left_m;
  };

  static Leg begin_leg(const Person& person) {
    const double distance_m = distance_to_target(person);
    return {person.id, person.area_lower, person.area_upper, distance_m, distance_m};
  }

  void update(Leg& leg, const Person& person) {
    if (leg.lower == person.area_lower && leg.upper == person.area_upper) {
      leg.left_m = distance_to_target(person);
    } else {
      finished_m_.add(leg.whole_m);
      leg = begin_leg(person);
    }
  }

  void update_legs(const Sample& sample) {
    // usually the same people as before, at the same indices
    const std::size_t same_size = std::min(legs_.size(), sample.people.size());
    std::size_t same = 0;
    while (same < same_size && legs_[same].person_id == sample.people[same].id) {
      update(legs_[same], sample.people[same]);
      ++same;
    }
    if (same == legs_.size() && same == sample.people.size()) return;

    std::map<std::uint64_t, Leg> others;
    for (std::size_t i = same; i < legs_.size(); ++i) others.emplace(legs_[i].person_id, legs_[i]);
    legs_.erase(legs_.begin() + static_cast<std::ptrdiff_t>(same), legs_.end());
    for (std::size_t i = same; i < sample.people.size(); ++i) {
      const Person& person = sample.people[i];
      const auto known = others.find(person.id);
      legs_.push_back(known != others.end() ? known->second : begin_leg(person));
      if (known == others.end()) continue;
      others.erase(known);
      update(legs_.back(), person);
    }
    for (const auto& [id, leg] : others) finished_m_.add(leg.whole_m);
  }

  double gained_m() const {
    CompensatedSum sum_m = finished_m_;
    for (const Leg& leg : legs_) sum_m.add(leg.whole_m - leg.left_m);
    return sum_m.value();
  }

  std::vector<Leg> legs_;         // of the people at the last sample, in their order
  CompensatedSum finished_m_;     // sum over all finished legs
  std::size_t most_people_ = 0;   // at the same time
  std::vector<double> gained_m_;  // of the crowd, at 0, 1, 2, ... s
  TimeMoments speed_, desired_speed_;
};

}  // namespace dmrp::metrics
