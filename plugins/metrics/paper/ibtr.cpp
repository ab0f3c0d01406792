// SPDX-License-Identifier: MIT
#include "metrics/paper/ibtr.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <string>
#include <tuple>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/speed_of.hpp"
#include "metrics/measure/thresholds.hpp"
#include "metrics/measure/time_span.hpp"

namespace dmrp::metrics {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

double percent_of(std::int64_t part_ns, std::int64_t whole_ns) {
  return whole_ns > 0 ? 100.0 * static_cast<double>(part_ns) / static_cast<double>(whole_ns) : undefined;
}

}  // namespace

Descriptor Ibtr::describe() {
  return describe_metric("dmrp.metric.ibtr", "Inter-robot blocking time ratio")
      .summary("share of the mission in which two active robots near each other both crawl")
      .source("Hu et al., DMRP-Bench, ICRA 2026: IBTR")
      .value("ibtr", "%", Direction::lower_is_better, Subjects::system_and_robots,
             "time in which two active robots are within distance_m and both slower than speed_fraction of their own "
             "mean speed while active, over mission time; events of several pairs count as their union; robot: its own "
             "events; undefined if planning failed")
      .value("ibtr_pair_sum", "%", Direction::lower_is_better, Subjects::system,
             "the same, with the events of all pairs added up: may exceed 100; undefined if planning failed")
      .value("ibtr_by_distance", "%", Direction::lower_is_better, Subjects::system,
             "ibtr with each of distances_m in place of distance_m, over that distance (m); undefined if planning "
             "failed")
      .curve()
      .value("ibtr_by_speed_fraction", "%", Direction::lower_is_better, Subjects::system,
             "ibtr with each of speed_fractions in place of speed_fraction, over that share (1); undefined if planning "
             "failed")
      .curve();
}

void Ibtr::begin(const dmrp_plan*) {
  robot_count_ = world().robots().size();
  active_.begin(robot_count_);
  pace_.assign(robot_count_, {});
  times_ns_.clear();
  speeds_.clear();
  open_since_.assign(robot_count_ * robot_count_, none);
  encounters_.clear();
  widest_m_ = distance_m;
  for (const double each_m : *distances_m) widest_m_ = std::max(widest_m_, each_m);
  meetings_.clear();
}

void Ibtr::observe(const Sample& sample) {
  active_.observe(sample);
  times_ns_.push_back(sample.t_ns);
  for (std::size_t robot = 0; robot < robot_count_; ++robot) {
    speeds_.push_back(speed_of(sample.robots[robot]));
    if (active_.in_step(robot)) pace_[robot].add(speeds_.back(), sample.dt_ns);
  }

  const double squared_reach = distance_m * distance_m;
  for (std::uint32_t a = 0; a < robot_count_; ++a) {
    for (std::uint32_t b = a + 1; b < robot_count_; ++b) {
      const bool both = active_.in_step(a) && active_.in_step(b);
      const double squared_distance =
          toolkit::squared_distance(toolkit::position(sample.robots[a].pose), toolkit::position(sample.robots[b].pose));
      follow_encounter(a, b, both && squared_distance <= squared_reach);
      if (both && squared_distance <= widest_m_ * widest_m_)
        meetings_.push_back({times_ns_.size() - 1, a, b, squared_distance});
    }
  }
}

// Opens or closes the pair's encounter at the newest sample.
void Ibtr::follow_encounter(std::uint32_t a, std::uint32_t b, bool near) {
  std::size_t& since = open_since_[a * robot_count_ + b];
  const std::size_t now = times_ns_.size() - 1;
  if (near && since == none) since = now;
  if (!near && since != none) {
    encounters_.push_back({a, b, since, now - 1});
    since = none;
  }
}

// A robot that never moved has no pace to fall below: it is in the way, but does not crawl.
bool Ibtr::both_crawl(std::uint32_t a, std::uint32_t b, std::size_t sample,
                      const std::vector<double>& thresholds) const {
  const double* speeds = &speeds_[sample * robot_count_];
  return speeds[a] < thresholds[a] && speeds[b] < thresholds[b];
}

std::vector<double> Ibtr::speed_thresholds(double fraction) const {
  std::vector<double> thresholds;
  for (const TimeMoments& pace : pace_) thresholds.push_back(fraction * pace.mean());
  return thresholds;
}

// The union of events as the sum of the steps in which some pair has one.
double Ibtr::blocked_percent(double reach_m, double fraction, std::int64_t mission_ns) const {
  const std::vector<double> thresholds = speed_thresholds(fraction);
  std::int64_t blocked_ns = 0;
  std::size_t counted = 0;  // the last sample that was
  for (const Meeting& meeting : meetings_) {
    if (meeting.sample == counted || meeting.squared_distance > reach_m * reach_m) continue;
    if (!both_crawl(meeting.a, meeting.b, meeting.sample, thresholds)) continue;
    counted = meeting.sample;
    blocked_ns += times_ns_[counted] - times_ns_[counted - 1];
  }
  return percent_of(blocked_ns, mission_ns);
}

// Cuts the encounters to the times in which both robots crawl. In order of beginning, then of the robots.
std::vector<Ibtr::Congestion> Ibtr::congestions() const {
  const std::vector<double> thresholds = speed_thresholds(speed_fraction);
  std::vector<Congestion> found;
  for (const Encounter& encounter : encounters_) {
    bool open = false;
    for (std::size_t sample = encounter.first; sample <= encounter.last; ++sample) {
      const bool crawl = both_crawl(encounter.a, encounter.b, sample, thresholds);
      if (crawl && !open) found.push_back({times_ns_[sample - 1], 0, encounter.a, encounter.b});
      if (crawl) found.back().to_ns = times_ns_[sample];
      open = crawl;
    }
  }
  std::sort(found.begin(), found.end(), [](const Congestion& x, const Congestion& y) {
    return std::tie(x.from_ns, x.a, x.b) < std::tie(y.from_ns, y.a, y.b);
  });
  return found;
}

void Ibtr::finish(const TrialEnd& end, MetricSink& sink) {
  // what is still open ends with the trial
  for (std::uint32_t a = 0; a < robot_count_; ++a)
    for (std::uint32_t b = a + 1; b < robot_count_; ++b)
      if (const std::size_t since = open_since_[a * robot_count_ + b]; since != none)
        encounters_.push_back({a, b, since, times_ns_.size() - 1});

  UnionLength blocked;
  std::vector<UnionLength> blocked_of(robot_count_);
  std::int64_t pair_sum_ns = 0;
  for (const Congestion& congestion : congestions()) {
    blocked.add(congestion.from_ns, congestion.to_ns);
    blocked_of[congestion.a].add(congestion.from_ns, congestion.to_ns);
    blocked_of[congestion.b].add(congestion.from_ns, congestion.to_ns);
    pair_sum_ns += congestion.to_ns - congestion.from_ns;
    sink.event("ibtr", congestion.from_ns, congestion.to_ns, {congestion.a, congestion.b},
               "robots " + std::to_string(congestion.a) + " and " + std::to_string(congestion.b) + " block each other");
  }

  const std::int64_t mission_ns = times_ns_.empty() ? 0 : end.t_ns;
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
