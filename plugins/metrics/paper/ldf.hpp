// SPDX-License-Identifier: MIT
// ldf.hpp: local density fluctuation: the variance of the number of robots around a robot.
#pragma once

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

class Ldf final : public Metric {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.ldf", "Local density fluctuation")
        .summary("variance over time of the number of robots around a robot")
        .source("Hu et al., DMRP-Bench, ICRA 2026: LDF")
        .value(
            "ldf", "1", lower_is_better, system_and_robots,
            "variance (normalised by n) of the number of robots within distance_m, including parked ones, counted "
            "every period_s from 0 to the end of the trial; system: maximum over robots; undefined if planning failed",
            never_negative)
        .value("ldf_active", "1", lower_is_better, system_and_robots,
               "the same for active robots only, counted while the robot itself is active; system: maximum over "
               "robots; undefined if planning failed",
               never_negative)
        .value("ldf_by_distance", "1", lower_is_better, Subjects::system,
               "ldf over distances_m; undefined if planning failed", never_negative)
        .curve();
  }

  Param<double> distance_m =
      param("distance_m", 2.0).unit("m").range(0.0, 100.0).doc("R: robots at most this far away are neighbours");
  Param<double> period_s = param("period_s", 1.0).unit("s").range(0.001, 60.0).doc("time between two counts");
  Param<std::vector<double>> distances_m = param("distances_m", std::vector<double>{1.0, 1.5, 2.0, 2.5, 3.0})
                                               .unit("m")
                                               .range(0.0, 100.0)
                                               .doc("values of R for the curve ldf_by_distance");

  void begin(const MetricTrial&) override {
    const std::size_t robot_count = world().robots().size();
    period_ns_ = std::llround(period_s * 1e9);
    next_ns_ = 0;
    active_.begin(robot_count);
    reaches_m_ = *distances_m;
    reaches_m_.push_back(distance_m);
    within_.assign(reaches_m_.size(), std::vector<Counts>(robot_count));
    active_only_.assign(robot_count, {});
  }

  void observe(const Sample& sample) override {
    active_.observe(sample);
    // an instant between two samples belongs to the step that contains it
    std::int64_t times = 0;
    for (; next_ns_ <= sample.t_ns; next_ns_ += period_ns_) ++times;
    if (times > 0) count_neighbours(sample, times);
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    const auto variances = [](const std::vector<Counts>& counts) { return values_of(counts, &Counts::variance); };
    give(sink, "ldf", &greatest_of_defined, variances(within_.back()));
    give(sink, "ldf_active", &greatest_of_defined, variances(active_only_));
    give_curve(sink, "ldf_by_distance", distances_m, [&](double each_m) {
      const auto row = std::find(reaches_m_.begin(), reaches_m_.end(), each_m) - reaches_m_.begin();
      return greatest_of_defined(variances(within_[static_cast<std::size_t>(row)]));
    });
  }

 private:
  // Counts of neighbours. Their variance is computed with integers, so only the last division rounds.
  struct Counts {
    std::int64_t instants = 0, sum = 0, squares = 0;

    void add(std::int64_t neighbours, std::int64_t times) {
      instants += times;
      sum += neighbours * times;
      squares += neighbours * neighbours * times;
    }

    // normalised by n; NaN without an instant
    double variance() const {
      if (instants == 0) return undefined;
      return static_cast<double>(instants * squares - sum * sum) / static_cast<double>(instants * instants);
    }
  };

  void count_neighbours(const Sample& sample, std::int64_t times) {
    for (std::size_t robot = 0; robot < active_only_.size(); ++robot) {
      const Vec2 position = toolkit::position(sample.robots[robot].pose);
      std::int64_t active_neighbours = 0;
      neighbours_.assign(reaches_m_.size(), 0);
      for (std::size_t other = 0; other < active_only_.size(); ++other) {
        if (other == robot) continue;
        const Vec2 there = toolkit::position(sample.robots[other].pose);
        const double squared_distance = toolkit::squared_distance(position, there);
        for (std::size_t row = 0; row < reaches_m_.size(); ++row)
          neighbours_[row] += squared_distance <= reaches_m_[row] * reaches_m_[row];
        active_neighbours += squared_distance <= distance_m * distance_m && active_.at_instant(other);
      }
      for (std::size_t row = 0; row < reaches_m_.size(); ++row) within_[row][robot].add(neighbours_[row], times);
      if (active_.at_instant(robot)) active_only_[robot].add(active_neighbours, times);
    }
  }

  std::int64_t period_ns_ = 0;
  std::int64_t next_ns_ = 0;  // the next instant of counting
  ActiveSteps active_;
  std::vector<double> reaches_m_;            // distances_m, then distance_m
  std::vector<std::int64_t> neighbours_;     // of one robot at one instant, by reach
  std::vector<std::vector<Counts>> within_;  // by reach and robot: all robots, over the whole trial
  std::vector<Counts> active_only_;          // by robot: active robots, while active itself
};

}  // namespace dmrp::metrics
