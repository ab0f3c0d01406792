// SPDX-License-Identifier: MIT
#include "controllers/e3mop/lay_by.hpp"

#include <algorithm>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::controllers::e3mop {

namespace {

// Whoever is faster than this in the direction of the path drives ahead of the robot.
constexpr double ahead_m_s = 0.1;

// The place is so many points of the path before the first one that is blocked: a robot that comes closer leaves the
// other one no room to turn aside.
constexpr std::size_t points_before = 5;

// The costmap's cells and the path's steps make somebody larger by up to this much.
constexpr double enlarged_m = 0.1;

// Places nearer to the path are of no use.
constexpr double least_m = 0.1;
constexpr double step_m = 0.01;

// The radius of the largest agent that blocks a point of the path and does not drive ahead.
std::optional<double> radius_of_opposite(const Observation& now, Vec2 point, Vec2 forward, double prediction_time_s,
                                         double needed_m) {
  std::optional<double> radius_m;
  for (const Agent& agent : now.agents) {
    if (agent.state != DMRP_ROBOT_ACTIVE && agent.kind == DMRP_AGENT_ROBOT) continue;
    if (toolkit::dot(agent.velocity, forward) > ahead_m_s) continue;
    const Vec2 from = toolkit::position(agent.pose);
    const Segment swept = {from, from + prediction_time_s * agent.velocity};
    if (toolkit::distance(swept, point) > agent.radius_m + needed_m + enlarged_m) continue;
    radius_m = std::max(radius_m.value_or(0.0), agent.radius_m);
  }
  return radius_m;
}

}  // namespace

std::optional<Vec2> lay_by(const Observation& now, const std::vector<Vec2>& path, double prediction_time_s,
                           const FreeSpace& free_space) {
  const auto is_free = [&](Vec2 point) { return free_space.can_stand(point); };
  const auto blocked = std::find_if_not(path.begin(), path.end(), is_free);
  if (blocked == path.end() || path.size() < 2) return {};
  const auto first = static_cast<std::size_t>(blocked - path.begin());
  const std::size_t base = first - std::min(first, points_before);
  const std::size_t next = std::min(base + 1, path.size() - 1);
  const Vec2 forward = toolkit::normalized(path[next] - path[next - 1]);
  const double needed_m = free_space.needed_m();
  const std::optional<double> radius_m = now.agents.empty()
                                             ? now.footprint.radius_m
                                             : radius_of_opposite(now, *blocked, forward, prediction_time_s, needed_m);
  if (!radius_m) return {};
  const Vec2 right = {forward.y, -forward.x};
  for (double aside_m = *radius_m + needed_m + enlarged_m; aside_m > least_m; aside_m -= step_m)
    if (is_free(path[base] + aside_m * right)) return path[base] + aside_m * right;
  return {};
}

}  // namespace dmrp::controllers::e3mop
