// SPDX-License-Identifier: MIT
// ibtr.hpp: inter-robot blocking time ratio: the share of the mission in which two robots near each other both crawl.
#pragma once

#include <limits>
#include <map>
#include <utility>

#include "metrics/measure/bases.hpp"
#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

class Ibtr final : public ActiveTimeMetric<TimeMoments> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.ibtr", "Inter-robot blocking time ratio")
        .summary("share of the mission in which two active robots near each other both crawl")
        .source("Hu et al., DMRP-Bench, ICRA 2026: IBTR")
        .value("ibtr", "%", lower_is_better, system_and_robots,
               "time in which two active robots are within distance_m and both slower than speed_fraction of their own "
               "mean speed while active, over mission time; the union over pairs; robot: its pairs; undefined if "
               "planning failed",
               percent_range)
        .value("ibtr_pair_sum", "%", lower_is_better, Subjects::system,
               "the same with the sum over pairs; can exceed 100; undefined if planning failed", never_negative)
        .value("ibtr_by_distance", "%", lower_is_better, Subjects::system,
               "ibtr over distances_m; undefined if planning failed", percent_range)
        .curve()
        .value("ibtr_by_speed_fraction", "%", lower_is_better, Subjects::system,
               "ibtr over speed_fractions; undefined if planning failed", percent_range)
        .curve();
  }

  Param<double> distance_m =
      param("distance_m", 2.0).unit("m").range(0.0, 100.0).doc("d: robots at most this far apart can block each other");
  Param<double> speed_fraction = param("speed_fraction", 0.2)
                                     .unit("1")
                                     .range(0.0, 10.0)
                                     .doc("v_thresh as a share of the robot's own mean speed; slower robots crawl");
  Param<std::vector<double>> distances_m = param("distances_m", std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0})
                                               .unit("m")
                                               .range(0.0, 100.0)
                                               .doc("values of d for the curve ibtr_by_distance");
  Param<std::vector<double>> speed_fractions =
      param("speed_fractions", std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5})
          .unit("1")
          .range(0.0, 10.0)
          .doc("values of speed_fraction for the curve ibtr_by_speed_fraction");

  void begin(const MetricTrial& trial) override {
    ActiveTimeMetric::begin(trial);
    widest_m_ = distance_m;
    for (const double each_m : *distances_m) widest_m_ = std::max(widest_m_, each_m);
    last_ns_ = -1;
    steps_.clear();
    encounters_.clear();
  }

  void observe(const Sample& sample) override {
    ActiveTimeMetric::observe(sample);
    sort_robots(robots_, sample);
    const std::size_t encounters_before = encounters_.size();
    for (std::uint32_t a = 0; a < states_.size(); ++a) {
      if (!active_.in_step(a)) continue;
      for (const std::uint32_t b : robots_.near(toolkit::position(sample.robots[a].pose), widest_m_)) {
        if (b <= a || !active_.in_step(b)) continue;
        const double squared_distance = toolkit::squared_distance(toolkit::position(sample.robots[a].pose),
                                                                  toolkit::position(sample.robots[b].pose));
        if (squared_distance > widest_m_ * widest_m_) continue;
        encounters_.push_back({static_cast<std::uint32_t>(steps_.size()), a, b, squared_distance,
                               speed_of(sample.robots[a]), speed_of(sample.robots[b])});
      }
    }
    if (encounters_.size() > encounters_before) steps_.push_back({last_ns_, sample.t_ns});
    last_ns_ = sample.t_ns;
  }

  void finish(const TrialEnd& end, MetricSink& sink) override {
    UnionLength blocked;
    std::vector<UnionLength> blocked_of(states_.size());
    std::int64_t pair_sum_ns = 0;
    for (const auto& [time, a, b] : congestions()) {
      blocked.add(time.from_ns, time.to_ns);
      blocked_of[a].add(time.from_ns, time.to_ns);
      blocked_of[b].add(time.from_ns, time.to_ns);
      pair_sum_ns += time.to_ns - time.from_ns;
      give_event(sink, "ibtr", time, {a, b},
                 "robots " + std::to_string(a) + " and " + std::to_string(b) + " block each other");
    }

    const std::int64_t mission_ns = last_ns_ < 0 ? 0 : end.t_ns;
    for (std::size_t robot = 0; robot < states_.size(); ++robot)
      sink.robot("ibtr", robot, percent_of(blocked_of[robot].value_ns(), mission_ns));
    const bool measured = !states_.empty();
    sink.system("ibtr", measured ? percent_of(blocked.value_ns(), mission_ns) : undefined);
    sink.system("ibtr_pair_sum", measured ? percent_of(pair_sum_ns, mission_ns) : undefined);
    give_curve(sink, "ibtr_by_distance", distances_m, [&](double each_m) {
      return measured ? blocked_percent(each_m, speed_fraction, mission_ns) : undefined;
    });
    give_curve(sink, "ibtr_by_speed_fraction", speed_fractions, [&](double fraction) {
      return measured ? blocked_percent(distance_m, fraction, mission_ns) : undefined;
    });
  }

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  // A pair of active robots in a step in which they were near each other, by the widest of the distances.
  struct Encounter {
    std::uint32_t step;  // index of steps_
    std::uint32_t a, b;
    double squared_distance;
    double speed_a, speed_b;  // m/s, measured
  };
  // A time in which a pair was near each other, by distance_m, and both crawled.
  struct Congestion {
    Spell time;
    std::uint32_t a, b;
  };

  std::vector<double> speed_thresholds(double fraction) const {
    std::vector<double> thresholds;
    for (const TimeMoments& pace : states_) thresholds.push_back(fraction * pace.mean());
    return thresholds;
  }

  // A robot that never moved has a threshold of 0, so it never crawls, although it is in the way.
  static bool is_blocking(const Encounter& encounter, double reach_m, const std::vector<double>& thresholds) {
    return encounter.squared_distance <= reach_m * reach_m && encounter.speed_a < thresholds[encounter.a] &&
           encounter.speed_b < thresholds[encounter.b];
  }

  // The union of the pairs' congestions: the sum of the steps in which at least one pair is blocking.
  double blocked_percent(double reach_m, double fraction, std::int64_t mission_ns) const {
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
  std::vector<Congestion> congestions() const {
    const std::vector<double> thresholds = speed_thresholds(speed_fraction);
    std::vector<Congestion> found;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> latest;  // by pair, index of found
    for (const Encounter& encounter : encounters_) {
      if (!is_blocking(encounter, distance_m, thresholds)) continue;
      const Spell& step = steps_[encounter.step];
      const auto [place, is_new] = latest.try_emplace({encounter.a, encounter.b}, found.size());
      if (!is_new && found[place->second].time.to_ns == step.from_ns) {
        found[place->second].time.to_ns = step.to_ns;
      } else {
        place->second = found.size();
        found.push_back({step, encounter.a, encounter.b});
      }
    }
    return found;
  }

  void add_step(TimeMoments& pace, std::size_t robot, const Sample& sample) override {
    pace.add(speed_of(sample.robots[robot]), sample.dt_ns);
  }

  // The thresholds are known only at the end. Until then the metric keeps the speeds of robots that are near each
  // other.
  double widest_m_ = 0.0;          // of all distances
  toolkit::NeighbourGrid robots_;  // at the sample
  std::int64_t last_ns_ = -1;      // of the last sample; -1: there was none
  std::vector<Spell> steps_;
  std::vector<Encounter> encounters_;  // by step, then by robots
};

}  // namespace dmrp::metrics
