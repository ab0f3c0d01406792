// SPDX-License-Identifier: MIT
// planned_overlap.hpp: how much of its planned time a robot is near another one's place of about the same time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/plugin.hpp>
#include <dmrp/toolkit/neighbour_grid.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <vector>

namespace dmrp::metrics {

using Steps = std::vector<Vec2>;  // planned positions at step 0, 1, ... until the robot rests at its goal

// The waypoint of the final arrival at the last goal; waypoints after it are padding.
inline std::size_t final_arrival(const Path& path) {
  std::size_t last = path.size() - 1;
  while (last > 0 && toolkit::position(path[last - 1]) == toolkit::position(path[last])) --last;
  return last;
}

// The path at start_ns, start_ns + step_ns, ...: exactly its waypoints if they are one step apart.
inline Steps resample(const Path& path, std::int64_t start_ns, std::int64_t step_ns) {
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
inline bool overlaps(const Steps& own, std::size_t i, const Steps& other, double distance_m, std::size_t window) {
  const std::size_t from = i > window ? i - window : 0;
  for (std::size_t j = from; j <= i + window; ++j) {
    const Vec2 there = other[std::min(j, other.size() - 1)];
    if (toolkit::squared_distance(own[i], there) <= distance_m * distance_m) return true;
    if (j + 1 >= other.size()) return false;  // at rest: later steps are the same
  }
  return false;
}

// The longest way of a robot from one step to the next.
inline double longest_move_m(const std::vector<Steps>& all) {
  double longest = 0.0;
  for (const Steps& steps : all)
    for (std::size_t i = 1; i < steps.size(); ++i)
      longest = std::max(longest, toolkit::squared_distance(steps[i - 1], steps[i]));
  return std::sqrt(longest);
}

// Gives, by robot, the share of its waypoints that another robot's path overlaps: two robots overlap within
// distance_m(a, b), at most widest_m.
template <class Distance>
std::vector<double> overlapping_shares(const std::vector<Steps>& all, Distance distance_m, double widest_m,
                                       std::size_t window) {
  // who overlaps at a step is at most this far away at that step
  const double reach_m = widest_m + static_cast<double>(window) * longest_move_m(all);
  std::size_t longest = 0;
  for (const Steps& steps : all) longest = std::max(longest, steps.size());
  std::vector<std::size_t> overlapping(all.size(), 0);
  toolkit::NeighbourGrid grid;
  for (std::size_t i = 0; i < longest; ++i) {
    grid.build(all.size(), std::max(reach_m, 0.5),
               [&](std::size_t robot) { return all[robot][std::min(i, all[robot].size() - 1)]; });
    for (std::size_t robot = 0; robot < all.size(); ++robot) {
      if (i >= all[robot].size()) continue;
      bool near = false;
      grid.visit(all[robot][i], reach_m, [&](std::size_t other) {
        near = near || (other != robot && overlaps(all[robot], i, all[other], distance_m(robot, other), window));
      });
      overlapping[robot] += near;
    }
  }
  std::vector<double> shares;
  for (std::size_t robot = 0; robot < all.size(); ++robot)
    shares.push_back(static_cast<double>(overlapping[robot]) / static_cast<double>(all[robot].size()));
  return shares;
}

// Of a plan with at least one path.
inline std::vector<Steps> resample_all(const Plan& plan, std::int64_t step_ns) {
  std::int64_t start_ns = plan.path(0)[0].t_ns;
  for (std::size_t robot = 1; robot < plan.size(); ++robot) start_ns = std::min(start_ns, plan.path(robot)[0].t_ns);
  std::vector<Steps> all;
  for (std::size_t robot = 0; robot < plan.size(); ++robot)
    all.push_back(resample(plan.path(robot), start_ns, step_ns));
  return all;
}

}  // namespace dmrp::metrics
