// SPDX-License-Identifier: MIT
#include "metrics/paper/pfd.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/segment.hpp>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"

namespace dmrp::metrics {
namespace {

// From a point to the closest point of a non-empty path; waits are segments of length zero.
double distance_to(const Path& path, Vec2 point) {
  double nearest = toolkit::squared_distance(toolkit::position(path[0]), point);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Segment segment = {toolkit::position(path[i - 1]), toolkit::position(path[i])};
    nearest = std::min(nearest, toolkit::squared_distance(segment, point));
  }
  return std::sqrt(nearest);
}

}  // namespace

Descriptor Pfd::describe() {
  return describe_metric("dmrp.metric.pfd", "Path following deviation")
      .summary("mean distance of the robots from their planned paths")
      .source("Hu et al., DMRP-Bench, ICRA 2026: PFD")
      .value("pfd", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "mean over the control steps of active time of the distance from the robot to the closest point of its "
             "current path; undefined if planning failed")
      .value("pfd_max", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "maximum of the same distances; system: maximum over robots; undefined if planning failed")
      .value("pfd_sd", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "standard deviation (normalised by n) of the same distances; undefined if planning failed")
      .value("pfd_initial", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "pfd relative to the first plan; undefined if planning failed");
}

void Pfd::Deviation::add(double distance_m) {
  sum_m.add(distance_m);
  ++count;
  greatest_m = std::fmax(greatest_m, distance_m);
  const double before = distance_m - running_mean_m;
  running_mean_m += before / static_cast<double>(count);
  squares += before * (distance_m - running_mean_m);
}

double Pfd::Deviation::mean_m() const {
  return count > 0 ? sum_m.value() / static_cast<double>(count) : undefined;
}

double Pfd::Deviation::standard_deviation_m() const {
  return count > 0 ? std::sqrt(std::fmax(0.0, squares) / static_cast<double>(count)) : undefined;
}

void Pfd::begin(const dmrp_plan* plan) {
  first_plan_ = plan;
  active_.begin(world().robots().size());
  in_force_.assign(world().robots().size(), {});
  initial_.assign(world().robots().size(), {});
}

void Pfd::observe(const Sample& sample) {
  active_.observe(sample);
  if (!sample.control_tick) return;
  for (std::size_t robot = 0; robot < in_force_.size(); ++robot) {
    if (!active_.in_step(robot)) continue;
    const Vec2 position = toolkit::position(sample.robots[robot].pose);
    const auto measure = [&](const dmrp_plan* plan, Deviation& deviation) {
      if (plan) deviation.add(distance_to(Plan(*plan).path(robot), position));
    };
    measure(sample.plan, in_force_[robot]);
    measure(first_plan_, initial_[robot]);
  }
}

void Pfd::finish(const TrialEnd&, MetricSink& sink) {
  const auto mean = [](const Deviation& deviation) { return deviation.mean_m(); };
  give_mean(sink, "pfd", values_of(in_force_, mean));
  give(sink, "pfd_max", values_of(in_force_, [](const Deviation& deviation) { return deviation.greatest_m; }),
       &greatest_of_defined);
  give_mean(sink, "pfd_sd",
            values_of(in_force_, [](const Deviation& deviation) { return deviation.standard_deviation_m(); }));
  give_mean(sink, "pfd_initial", values_of(initial_, mean));
}

}  // namespace dmrp::metrics
