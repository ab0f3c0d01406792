// SPDX-License-Identifier: MIT
// pfd.hpp: path following deviation: the distance of robots from their planned paths.
#pragma once

#include <dmrp/toolkit/segment.hpp>

#include "metrics/measure/bases.hpp"

namespace dmrp::metrics {

// A robot's distances from its path. All statistics are NaN without a distance.
struct PathDeviation {
  CompensatedSum sum_m;
  std::size_t count = 0;
  double greatest_m = undefined;
  double running_mean_m = 0.0;  // Welford (1962)
  double squares = 0.0;         // sum of squared differences from the mean

  void add(double distance_m) {
    sum_m.add(distance_m);
    ++count;
    greatest_m = std::fmax(greatest_m, distance_m);
    const double before = distance_m - running_mean_m;
    running_mean_m += before / static_cast<double>(count);
    squares += before * (distance_m - running_mean_m);
  }

  double mean_m() const { return count > 0 ? sum_m.value() / static_cast<double>(count) : undefined; }

  // normalised by n
  double standard_deviation_m() const {
    return count > 0 ? std::sqrt(std::fmax(0.0, squares) / static_cast<double>(count)) : undefined;
  }
};

struct PathDeviations {
  PathDeviation in_force, initial, handed;
};

class Pfd final : public ActiveTimeMetric<PathDeviations> {
 public:
  static Descriptor describe() {
    return describe_metric("dmrp.metric.pfd", "Path following deviation")
        .summary("mean distance of the robots from their planned paths")
        .source("Hu et al., DMRP-Bench, ICRA 2026: PFD")
        .value("pfd", "m", lower_is_better, system_and_robots,
               "mean over the control steps of active time of the distance from the robot to the closest point of its "
               "current path; undefined if planning failed",
               never_negative)
        .value("pfd_max", "m", lower_is_better, system_and_robots,
               "maximum of the same distances; system: maximum over robots; undefined if planning failed",
               never_negative)
        .value("pfd_sd", "m", lower_is_better, system_and_robots,
               "standard deviation (normalised by n) of the same distances; undefined if planning failed",
               never_negative)
        .value("pfd_initial", "m", lower_is_better, system_and_robots,
               "pfd relative to the first plan; undefined if planning failed", never_negative)
        .value(
            "pfd_route", "m", lower_is_better, system_and_robots,
            "pfd relative to what the controller was handed to follow: the plan's stretch, or the local route around "
            "what stands on it; undefined if it was handed nothing",
            never_negative)
        .channels(DMRP_CHANNEL_ROUTES);
  }

  void begin(const MetricTrial& trial) override {
    ActiveTimeMetric::begin(trial);
    first_plan_ = trial.plan;
    handed_.assign(states_.size(), {});
  }

  void observe(const Sample& sample) override {
    ActiveTimeMetric::observe(sample);  // the step that ends here was driven along what was handed before
    for (const Route& route : sample.routes) {
      std::vector<Vec2>& handed = handed_[route.robot];
      handed.clear();
      for (const Waypoint& waypoint : route.path()) handed.push_back(toolkit::position(waypoint));
    }
  }

  void finish(const TrialEnd&, MetricSink& sink) override {
    give_mean(sink, "pfd", [](const PathDeviations& own) { return own.in_force.mean_m(); });
    give_of_states(sink, "pfd_max", &greatest_of_defined,
                   [](const PathDeviations& own) { return own.in_force.greatest_m; });
    give_mean(sink, "pfd_sd", [](const PathDeviations& own) { return own.in_force.standard_deviation_m(); });
    give_mean(sink, "pfd_initial", [](const PathDeviations& own) { return own.initial.mean_m(); });
    give_mean(sink, "pfd_route", [](const PathDeviations& own) { return own.handed.mean_m(); });
  }

 private:
  static Vec2 place_of(Vec2 point) { return point; }
  static Vec2 place_of(const Waypoint& waypoint) { return toolkit::position(waypoint); }

  // From a point to the closest point of a non-empty path; waits are segments of length zero.
  template <class Points>
  static double distance_to(const Points& path, Vec2 point) {
    double nearest = toolkit::squared_distance(place_of(path[0]), point);
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Segment segment = {place_of(path[i - 1]), place_of(path[i])};
      nearest = std::min(nearest, toolkit::squared_distance(segment, point));
    }
    return std::sqrt(nearest);
  }

  void add_step(PathDeviations& own, std::size_t robot, const Sample& sample) override {
    if (!sample.control_tick) return;
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    if (sample.plan) own.in_force.add(distance_to(sample.plan.path(robot), position));
    if (first_plan_) own.initial.add(distance_to(first_plan_.path(robot), position));
    if (!handed_[robot].empty()) own.handed.add(distance_to(handed_[robot], position));
  }

  Plan first_plan_;
  std::vector<std::vector<Vec2>> handed_;  // by robot: what its controller follows
};

}  // namespace dmrp::metrics
