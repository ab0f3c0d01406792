// SPDX-License-Identifier: MIT
#include "metrics/paper/sto.hpp"

#include <algorithm>
#include <dmrp/toolkit/vec2.hpp>
#include <stdexcept>
#include <vector>

#include "metrics/measure/describe_metric.hpp"
#include "metrics/measure/per_robot.hpp"
#include "metrics/measure/thresholds.hpp"

namespace dmrp::metrics {
namespace {

using Steps = std::vector<Vec2>;  // planned positions at step 0, 1, ... until the robot rests at its goal

// The waypoint of the final arrival at the last goal; waypoints after it are padding.
std::size_t final_arrival(const Path& path) {
  std::size_t last = path.size() - 1;
  while (last > 0 && toolkit::position(path[last - 1]) == toolkit::position(path[last])) --last;
  return last;
}

// The path at start_ns, start_ns + step_ns, ...: exactly its waypoints if they are one step apart.
Steps resample(const Path& path, std::int64_t start_ns, std::int64_t step_ns) {
  const std::size_t last = final_arrival(path);
  Steps steps;
  std::size_t next = 0;  // first waypoint that is not before the instant
  for (std::int64_t t_ns = start_ns;; t_ns += step_ns) {
    while (next < last && path[next].t_ns < t_ns) ++next;
    if (next == 0 || path[next].t_ns <= t_ns) {
      steps.push_back(toolkit::position(path[next]));
    } else {
      const Waypoint& from = path[next - 1];
      const double part = static_cast<double>(t_ns - from.t_ns) / static_cast<double>(path[next].t_ns - from.t_ns);
      steps.push_back(toolkit::lerp(toolkit::position(from), toolkit::position(path[next]), part));
    }
    if (path[last].t_ns <= t_ns) return steps;
  }
}

// Whether the plan has `other` near at a step from i - window to i + window. Robots rest at their goals.
bool overlaps(const Steps& own, std::size_t i, const Steps& other, double distance_m, std::size_t window) {
  const std::size_t from = i > window ? i - window : 0;
  for (std::size_t j = from; j <= i + window; ++j) {
    const Vec2 there = other[std::min(j, other.size() - 1)];
    if (toolkit::squared_distance(own[i], there) <= distance_m * distance_m) return true;
    if (j + 1 >= other.size()) return false;  // at rest: later steps are the same
  }
  return false;
}

// By robot: the share of its waypoints that another robot's path overlaps.
std::vector<double> overlapping_shares(const std::vector<Steps>& all, double distance_m, std::size_t window) {
  std::vector<double> shares;
  for (std::size_t robot = 0; robot < all.size(); ++robot) {
    std::size_t overlapping = 0;
    for (std::size_t i = 0; i < all[robot].size(); ++i) {
      bool near = false;
      for (std::size_t other = 0; other < all.size() && !near; ++other)
        near = other != robot && overlaps(all[robot], i, all[other], distance_m, window);
      overlapping += near;
    }
    shares.push_back(static_cast<double>(overlapping) / static_cast<double>(all[robot].size()));
  }
  return shares;
}

std::vector<Steps> resample_all(const Plan& plan) {
  if (plan->step_duration_ns <= 0) throw std::invalid_argument("STO needs a plan with a step duration above 0");
  std::int64_t start_ns = plan.path(0)[0].t_ns;
  for (std::size_t robot = 1; robot < plan.size(); ++robot) start_ns = std::min(start_ns, plan.path(robot)[0].t_ns);
  std::vector<Steps> all;
  for (std::size_t robot = 0; robot < plan.size(); ++robot)
    all.push_back(resample(plan.path(robot), start_ns, plan->step_duration_ns));
  return all;
}

}  // namespace

Descriptor Sto::describe() {
  return describe_metric("dmrp.metric.sto", "Spatio-temporal overlap")
      .summary("share of planned waypoints near another robot's waypoint of about the same step")
      .source("Hu et al., DMRP-Bench, ICRA 2026: STO")
      .value(
          "sto", "1", Direction::lower_is_better, Subjects::system_and_robots,
          "share of the robot's waypoints in the first plan (one a step, waits kept, until its goal) within "
          "distance_m of another robot's waypoint within window steps; system: mean over robots; undefined if planning "
          "failed")
      .value("sto_by_distance", "1", Direction::lower_is_better, Subjects::system,
             "the system's sto with each of distances_m instead of distance_m, over this distance (m); undefined if "
             "planning failed")
      .curve()
      .value("sto_cell_size", "m", Direction::none, Subjects::system,
             "c, the size of the planning grid's cells, which sto depends on; undefined if planning failed");
}

void Sto::finish(const TrialEnd&, MetricSink& sink) {
  const bool planned = first_plan_ && first_plan_->path_count > 0;
  const std::vector<Steps> all = planned ? resample_all(Plan(*first_plan_)) : std::vector<Steps>();
  const auto steps = static_cast<std::size_t>(*window);
  give_mean(sink, "sto", overlapping_shares(all, distance_m, steps));
  give_curve(sink, "sto_by_distance", distances_m,
             [&](double threshold_m) { return mean_of_defined(overlapping_shares(all, threshold_m, steps)); });
  sink.system("sto_cell_size", planned ? world().planning_grid().resolution_m : undefined);
}

}  // namespace dmrp::metrics
