// SPDX-License-Identifier: MIT
#include "metrics/paper/ibtr.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/speed_of.hpp"
#include "metrics/measure/thresholds.hpp"
#include "metrics/measure/time_span.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

double percent_of(std::int64_t part_ns, std::int64_t whole_ns) {
  return whole_ns > 0 ? 100.0 * static_cast<double>(part_ns) / static_cast<double>(whole_ns) : undefined;
}

}  // namespace

Descriptor Ibtr::describe() {
  return describe_metric("dmrp.metric.ibtr", "Inter-robot blocking time ratio")
      .summary("share of the mission in which two active robots near each other both crawl")
      .source("Hu et al., DMRP-Bench, ICRA 2026: IBTR")
      .value(
          "ibtr", "%", Direction::lower_is_better, Subjects::system_and_robots,
          "time in which two active robots are within distance_m and both slower than speed_fraction of their own mean "
          "speed while active, over mission time; the union over pairs; robot: its pairs; undefined if planning failed")
      .value("ibtr_pair_sum", "%", Direction::lower_is_better, Subjects::system,
             "the same with the sum over pairs; can exceed 100; undefined if planning failed")
      .value("ibtr_by_distance", "%", Direction::lower_is_better, Subjects::system,
             "ibtr over distances_m; undefined if planning failed")
      .curve()
      .value("ibtr_by_speed_fraction", "%", Direction::lower_is_better, Subjects::system,
             "ibtr over speed_fractions; undefined if planning failed")
      .curve();
}

void Ibtr::begin(const dmrp_plan*) {
  robot_count_ = world().robots().size();
  active_.begin(robot_count_);
  pace_.assign(robot_count_, {});
  widest_m_ = distance_m;
  for (const double each_m : *distances_m) widest_m_ = std::max(widest_m_, each_m);
  last_ns_ = -1;
  steps_.clear();
  encounters_.clear();
}

void Ibtr::observe(const Sample& sample) {
  active_.observe(sample);
  for (std::size_t robot = 0; robot < robot_count_; ++robot)
    if (active_.in_step(robot)) pace_[robot].add(speed_of(sample.robots[robot]), sample.dt_ns);

  const std::size_t encounters_before = encounters_.size();
  for (std::uint32_t a = 0; a < robot_count_; ++a) {
    if (!active_.in_step(a)) continue;
    for (std::uint32_t b = a + 1; b < robot_count_; ++b) {
      if (!active_.in_step(b)) continue;
      const double squared_distance =
          toolkit::squared_distance(toolkit::position(sample.robots[a].pose), toolkit::position(sample.robots[b].pose));
      if (squared_distance > widest_m_ * widest_m_) continue;
      encounters_.push_back({static_cast<std::uint32_t>(steps_.size()), a, b, squared_distance,
                             speed_of(sample.robots[a]), speed_of(sample.robots[b])});
    }
  }
  if (encounters_.size() > encounters_before) steps_.push_back({last_ns_, sample.t_ns});
  last_ns_ = sample.t_ns;
}

std::vector<double> Ibtr::speed_thresholds(double fraction) const {
  std::vector<double> thresholds;
  for (const TimeMoments& pace : pace_) thresholds.push_back(fraction * pace.mean());
  return thresholds;
}

// A robot that never moved has a threshold of 0, so it never crawls, although it is in the way.
bool Ibtr::is_blocking(const Encounter& encounter, double reach_m, const std::vector<double>& thresholds) {
  return encounter.squared_distance <= reach_m * reach_m && encounter.speed_a < thresholds[encounter.a] &&
         encounter.speed_b < thresholds[encounter.b];
}

// The union of the pairs' congestions: the sum of the steps in which at least one pair is blocking.
double Ibtr::blocked_percent(double reach_m, double fraction, std::int64_t mission_ns) const {
  const std::vector<double> thresholds = speed_thresholds(fraction);
  std::int64_t blocked_ns = 0;
  std::uint32_t last_counted = none;
  for (const Encounter& encounter : encounters_) {
    if (encounter.step == last_counted || !is_blocking(encounter, reach_m, thresholds)) continue;
    last_counted = encounter.step;
    blocked_ns += steps_[encounter.step].to_ns - steps_[encounter.step].from_ns;
  }
  return percent_of(blocked_ns, mission_ns);
}

// Joins each pair's adjacent steps. In order of beginning, then of the robots.
std::vector<Ibtr::Congestion> Ibtr::congestions() const {
  const std::vector<double> thresholds = speed_thresholds(speed_fraction);
  std::vector<Congestion> found;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> latest;  // by pair, index of found
  for (const Encounter& encounter : encounters_) {
    if (!is_blocking(encounter, distance_m, thresholds)) continue;
    const Step& step = steps_[encounter.step];
    const auto [place, is_new] = latest.try_emplace({encounter.a, encounter.b}, found.size());
    if (!is_new && found[place->second].to_ns == step.from_ns) {
      found[place->second].to_ns = step.to_ns;
    } else {
      place->second = found.size();
      found.push_back({step.from_ns, step.to_ns, encounter.a, encounter.b});
    }
  }
  return found;
}

void Ibtr::finish(const TrialEnd& end, MetricSink& sink) {
  UnionLength blocked;
  std::vector<UnionLength> blocked_of(robot_count_);
  std::int64_t pair_sum_ns = 0;
  for (const Congestion& congestion : congestions()) {
    blocked.add(congestion.from_ns, congestion.to_ns);
    blocked_of[congestion.a].add(congestion.from_ns, congestion.to_ns);
    blocked_of[congestion.b].add(congestion.from_ns, congestion.to_ns);
    pair_sum_ns += congestion.to_ns - congestion.from_ns;
    sink.event(
        {"ibtr",
         congestion.from_ns,
         congestion.to_ns,
         {robot_subject(congestion.a), robot_subject(congestion.b)},
         "robots " + std::to_string(congestion.a) + " and " + std::to_string(congestion.b) + " block each other"});
  }

  const std::int64_t mission_ns = last_ns_ < 0 ? 0 : end.t_ns;
  for (std::size_t robot = 0; robot < robot_count_; ++robot)
    sink.robot("ibtr", robot, percent_of(blocked_of[robot].value_ns(), mission_ns));
  const bool measured = robot_count_ > 0;
  sink.system("ibtr", measured ? percent_of(blocked.value_ns(), mission_ns) : undefined);
  sink.system("ibtr_pair_sum", measured ? percent_of(pair_sum_ns, mission_ns) : undefined);
  give_curve(sink, "ibtr_by_distance", distances_m,
             [&](double each_m) { return measured ? blocked_percent(each_m, speed_fraction, mission_ns) : undefined; });
  give_curve(sink, "ibtr_by_speed_fraction", speed_fractions,
             [&](double fraction) { return measured ? blocked_percent(distance_m, fraction, mission_ns) : undefined; });
}

}  // namespace dmrp::metrics
