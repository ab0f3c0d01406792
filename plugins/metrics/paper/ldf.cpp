// SPDX-License-Identifier: MIT
#include "ldf.hpp"

#include <cmath>
#include <dmrp/toolkit/vec2.hpp>

#include "../measure/describe_metric.hpp"

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
             "variance (1/n) of the number of robots within distance_m, parked ones too, counted each period_s from 0 "
             "to the trial's end; system: maximum over robots; undefined if planning failed")
      .value("ldf_active", "1", Direction::lower_is_better, Subjects::system_and_robots,
             "the same among active robots only, counted while the robot itself is active; undefined if planning "
             "failed");
}

void Ldf::begin(const dmrp_plan*) {
  const std::size_t robot_count = world().robots().size();
  period_ns_ = std::llround(period_s * 1e9);
  next_ns_ = 0;
  active_.begin(robot_count);
  all_.assign(robot_count, {});
  active_only_.assign(robot_count, {});
}

void Ldf::observe(const Sample& sample) {
  active_.observe(sample);
  // an instant between two samples is counted with the step that it falls into
  std::int64_t times = 0;
  for (; next_ns_ <= sample.t_ns; next_ns_ += period_ns_) ++times;
  if (times > 0) count_neighbours(sample, times);
}

void Ldf::count_neighbours(const Sample& sample, std::int64_t times) {
  const double squared_reach = distance_m * distance_m;
  for (std::size_t robot = 0; robot < all_.size(); ++robot) {
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    std::int64_t neighbours = 0, active_neighbours = 0;
    for (std::size_t other = 0; other < all_.size(); ++other) {
      if (other == robot) continue;
      if (toolkit::squared_distance(position, toolkit::position(sample.robots[other].pose)) > squared_reach) continue;
      ++neighbours;
      active_neighbours += active_.at_instant(other);
    }
    all_[robot].add(neighbours, times);
    if (active_.at_instant(robot)) active_only_[robot].add(active_neighbours, times);
  }
}

void Ldf::finish(const TrialEnd&, MetricSink& sink) {
  const auto give = [&](const char* name, const std::vector<Counts>& counts) {
    double largest = undefined;
    for (std::size_t robot = 0; robot < counts.size(); ++robot) {
      const double variance = counts[robot].variance();
      sink.robot(name, robot, variance);
      largest = std::fmax(largest, variance);  // takes the number where one is NaN
    }
    sink.system(name, largest);
  };
  give("ldf", all_);
  give("ldf_active", active_only_);
}

}  // namespace dmrp::metrics
