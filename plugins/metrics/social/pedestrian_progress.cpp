// SPDX-License-Identifier: MIT
#include "metrics/social/pedestrian_progress.hpp"

#include <algorithm>
#include <dmrp/toolkit/rectangle.hpp>
#include <map>

#include "metrics/measure/describe_metric.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::int64_t sample_period_ns = 1'000'000'000;

double distance_to_target(const Person& person) {
  return toolkit::distance(toolkit::Rectangle{person.area_lower, person.area_upper}, person.position);
}

}  // namespace

Descriptor PedestrianProgress::describe() {
  return describe_metric("dmrp.metric.pedestrian_progress", "Pedestrian progress")
      .summary("progress of people toward their targets over time, and their speeds")
      .source("own definition, for comparing a crowd with and without robots")
      .channels(DMRP_CHANNEL_PEOPLE)
      .value("pedestrian_progress", "m", Direction::higher_is_better, Subjects::system,
             "over time t = 0, 1, 2, ... s: (1/n) sum over all people of the progress until t, n the number of people "
             "in the world at once; a finished leg counts with its straight length to the target area, the current one "
             "with what is done of it; undefined without people")
      .curve()
      .value("pedestrian_speed", "m/s", Direction::higher_is_better, Subjects::system,
             "mean of |v| over time and present people; undefined without people")
      .value("pedestrian_desired_speed", "m/s", Direction::none, Subjects::system,
             "mean of the desired speed over time and present people; undefined without people");
}

void PedestrianProgress::begin(const dmrp_plan*) {
  legs_.clear();
  finished_m_ = {};
  most_people_ = 0;
  gained_m_.clear();
  speed_ = {};
  desired_speed_ = {};
}

void PedestrianProgress::observe(const Sample& sample) {
  update_legs(sample);
  most_people_ = std::max(most_people_, sample.people.size());
  for (const Person& person : sample.people) {
    speed_.add(toolkit::norm(person.velocity), sample.dt_ns);
    desired_speed_.add(person.desired_speed, sample.dt_ns);
  }
  // an instant between two samples belongs to the step that contains it
  while (static_cast<std::int64_t>(gained_m_.size()) * sample_period_ns <= sample.t_ns) gained_m_.push_back(gained_m());
}

PedestrianProgress::Leg PedestrianProgress::begin_leg(const Person& person) {
  const double distance_m = distance_to_target(person);
  return {person.id, person.area_lower, person.area_upper, distance_m, distance_m};
}

void PedestrianProgress::update(Leg& leg, const Person& person) {
  if (leg.lower == person.area_lower && leg.upper == person.area_upper) {
    leg.left_m = distance_to_target(person);
  } else {
    finished_m_.add(leg.whole_m);
    leg = begin_leg(person);
  }
}

void PedestrianProgress::update_legs(const Sample& sample) {
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

double PedestrianProgress::gained_m() const {
  CompensatedSum sum_m = finished_m_;
  for (const Leg& leg : legs_) sum_m.add(leg.whole_m - leg.left_m);
  return sum_m.value();
}

void PedestrianProgress::finish(const TrialEnd&, MetricSink& sink) {
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

}  // namespace dmrp::metrics
