// SPDX-License-Identifier: MIT
#include "pfd.hpp"

#include <algorithm>
#include <cmath>
#include <dmrp/toolkit/segment.hpp>

#include "../measure/describe_metric.hpp"

namespace dmrp::metrics {
namespace {

// From a point to the closest point of a path that is not empty; waits are segments of length zero.
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
      .value(
          "pfd", "m", Direction::lower_is_better, Subjects::system_and_robots,
          "mean over the control steps of its active time of the distance from the robot to the closest point of its "
          "path in force; system: mean over robots; undefined if planning failed")
      .value("pfd_initial", "m", Direction::lower_is_better, Subjects::system_and_robots,
             "the same against the first plan: replans from the current pose do not pull it to zero; undefined if "
             "planning failed");
}

void Pfd::Deviation::add(double distance_m) {
  sum_m.add(distance_m);
  ++count;
}

double Pfd::Deviation::mean_m() const {
  return count > 0 ? sum_m.value() / static_cast<double>(count) : undefined;
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
  const auto give = [&](const char* name, const std::vector<Deviation>& deviations) {
    std::vector<double> means_m;
    for (std::size_t robot = 0; robot < deviations.size(); ++robot) {
      means_m.push_back(deviations[robot].mean_m());
      sink.robot(name, robot, means_m.back());
    }
    sink.system(name, mean_of_defined(means_m));
  };
  give("pfd", in_force_);
  give("pfd_initial", initial_);
}

}  // namespace dmrp::metrics
