// SPDX-License-Identifier: MIT
#include "metrics/paper/ldf.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/thresholds.hpp"

namespace dmrp::metrics {

void Ldf::Counts::add(std::int64_t neighbours, std::int64_t times) {
  instants += times;
  sum += neighbours * times;
  squares += neighbours * neighbours * times;
}

double Ldf::Counts::variance() const {
  if (instants == 0) return undefined;
  return static_cast<double>(instants * squares - sum * sum) / static_cast<double>(instants * instants);
}

Descriptor Ldf::describe() {
  return describe_metric("dmrp.metric.ldf", "Local density fluctuation")
      .summary("variance over time of the number of robots around a robot")
      .source("Hu et al., DMRP-Bench, ICRA 2026: LDF")
      .value("ldf", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "variance (normalised by n) of the number of robots within distance_m, including parked ones, counted "
             "every period_s from 0 to the end of the trial; system: maximum over robots; undefined if planning failed")
      .value("ldf_active", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "the same for active robots only, counted while the robot itself is active; system: maximum over robots; "
             "undefined if planning failed")
      .value("ldf_by_distance", "1", Direction::lower_is_better, Subjects::system,
             "ldf over distances_m; undefined if planning failed")
      .curve();
}

void Ldf::begin(const dmrp_plan*) {
  const std::size_t robot_count = world().robots().size();
  period_ns_ = std::llround(period_s * 1e9);
  next_ns_ = 0;
  active_.begin(robot_count);
  all_.assign(robot_count, {});
  active_only_.assign(robot_count, {});
  by_distance_.assign(robot_count * distances_m->size(), {});
}

void Ldf::observe(const Sample& sample) {
  active_.observe(sample);
  // an instant between two samples belongs to the step that contains it
  std::int64_t times = 0;
  for (; next_ns_ <= sample.t_ns; next_ns_ += period_ns_) ++times;
  if (times > 0) count_neighbours(sample, times);
}

void Ldf::count_neighbours(const Sample& sample, std::int64_t times) {
  const double squared_reach = distance_m * distance_m;
  for (std::size_t robot = 0; robot < all_.size(); ++robot) {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    std::int64_t neighbours = 0, active_neighbours = 0;
    squared_distances_.clear();
    for (std::size_t other = 0; other < all_.size(); ++other) {
      if (other == robot) continue;
      squared_distances_.push_back(toolkit::squared_distance(position, toolkit::position(sample.robots[other].pose)));
      if (squared_distances_.back() > squared_reach) continue;
      ++neighbours;
      active_neighbours += active_.at_instant(other);
    }
    all_[robot].add(neighbours, times);
    if (active_.at_instant(robot)) active_only_[robot].add(active_neighbours, times);
    count_by_distance(robot, times);
  }
}

void Ldf::count_by_distance(std::size_t robot, std::int64_t times) {
  for (std::size_t i = 0; i < distances_m->size(); ++i) {
    const double squared_reach = (*distances_m)[i] * (*distances_m)[i];
    std::int64_t neighbours = 0;
    for (const double squared_distance : squared_distances_) neighbours += squared_distance <= squared_reach;
    by_distance_[i * all_.size() + robot].add(neighbours, times);
  }
}

void Ldf::finish(const TrialEnd&, MetricSink& sink) {
  const auto variances = [](const std::vector<Counts>& counts) {
    return values_of(counts, [](const Counts& of_robot) { return of_robot.variance(); });
  };
  give(sink, "ldf", variances(all_), &greatest_of_defined);
  give(sink, "ldf_active", variances(active_only_), &greatest_of_defined);
  give_curve(sink, "ldf_by_distance", distances_m, [&](double each_m) {
    const auto row = std::find(distances_m->begin(), distances_m->end(), each_m) - distances_m->begin();
    const auto first = by_distance_.begin() + row * static_cast<std::ptrdiff_t>(all_.size());
    return greatest_of_defined(variances({first, first + static_cast<std::ptrdiff_t>(all_.size())}));
  });
}

}  // namespace dmrp::metrics
