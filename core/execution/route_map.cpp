// SPDX-License-Identifier: MIT
#include "core/execution/route_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <dmrp/toolkit/angle.hpp>
#include <dmrp/toolkit/grid_view.hpp>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>
#include <queue>

#include "core/execution/clear_way.hpp"

namespace dmrp::core {
namespace {

constexpr double slowest_moving_m_s = 0.15;  // m/s; what is slower stands
constexpr double against = -0.5;             // cosine: what comes toward the robot
constexpr double foresight_s = 3.0;          // of an oncoming robot's way
constexpr double closed_left_m = 1.5;        // beside an oncoming robot
constexpr double blur_m = 0.1;  // by which a moving body's marks reach beyond it: a cell, and where it has been
constexpr double cost_of_closeness = 2.0;

double distance_to(const dmrp_segment& segment, dmrp_vec2 point) {
  return toolkit::distance(point, toolkit::lerp(segment.from, segment.to, toolkit::closest_fraction(segment, point)));
}

}  // namespace

RouteMap::RouteMap(const View& view, const RobotSettings& robot) : view_(view), robot_(robot) {
  for (const dmrp_agent& agent : view.agents) {
    const bool yields = view.yields_to_robots && agent.kind == DMRP_AGENT_ROBOT;
    const bool moves = toolkit::norm(agent.velocity) > slowest_moving_m_s;
    if (yields || moves) left_out_.push_back(&agent);
    if (!yields && moves && agent.kind == DMRP_AGENT_ROBOT) meet(agent);
  }
}

// Closes an oncoming robot's way: `ahead` is where it will be while the robot comes up to it.
void RouteMap::meet(const dmrp_agent& other) {
  const dmrp_vec2 here = toolkit::position(view_.pose);
  const dmrp_vec2 there = toolkit::position(other.pose);
  const double speed = toolkit::norm(other.velocity);
  const dmrp_vec2 way = (1.0 / speed) * other.velocity;
  if (toolkit::dot(way, view_.direction) > against || toolkit::dot(there - here, view_.direction) < 0.0) return;
  const double apart_m = toolkit::distance(here, there);
  const double until_met_m = apart_m * speed / (speed + robot_.v_max);
  const double need_m = robot_.radius_m + other.radius_m + clear_gap_m;
  const dmrp_vec2 left = toolkit::perpendicular(view_.direction);
  const dmrp_vec2 shift = 0.5 * need_m * left;
  const dmrp_vec2 met = there + std::min(until_met_m, foresight_s * speed) * way + shift;
  oncoming_.push_back({{there + shift, met}, {met, met + closed_left_m * left}, need_m});
}

// Whether a moving body, which has no place in a route, is that near to the point.
bool RouteMap::is_left_out(dmrp_vec2 point, double beyond_m) const {
  return std::any_of(left_out_.begin(), left_out_.end(), [&](const dmrp_agent* agent) {
    return toolkit::distance(point, toolkit::position(agent->pose)) < agent->radius_m + beyond_m;
  });
}

std::uint8_t RouteMap::cost(dmrp_vec2 point) const {
  const dmrp_costmap& map = view_.costmap;
  const double column = std::floor((point.x - map.origin.x) / map.resolution_m);
  const double row = std::floor((point.y - map.origin.y) / map.resolution_m);
  if (column < 0.0 || row < 0.0 || column >= map.width || row >= map.height) return DMRP_COST_FREE;
  const std::uint8_t cost = map.costs[static_cast<std::size_t>(row) * map.width + static_cast<std::size_t>(column)];
  if (cost == DMRP_COST_FREE || left_out_.empty()) return cost;
  return is_left_out(point, cost == DMRP_COST_LETHAL ? blur_m : map.inflation_radius_m + blur_m) ? DMRP_COST_FREE
                                                                                                 : cost;
}

bool RouteMap::outline_is_free(dmrp_vec2 point, double heading) const {
  const dmrp_pose pose = {point.x, point.y, heading};
  const double step_m = view_.costmap.resolution_m;
  for (const ConvexPolygon& part : robot_.parts) {
    const ConvexPolygon body = toolkit::to_world(pose, part);
    for (std::size_t i = 0; i < body.size(); ++i) {
      const dmrp_vec2 from = body[i], to = body[(i + 1) % body.size()];
      const double steps = std::ceil(toolkit::distance(from, to) / step_m);
      for (double k = 0.0; k < steps; ++k)
        if (cost(toolkit::lerp(from, to, k / steps)) == DMRP_COST_LETHAL) return false;
    }
  }
  return true;
}

bool RouteMap::robot_is_free() const {
  return is_free(toolkit::position(view_.pose), view_.pose.theta);
}

RouteMap RouteMap::of_what_stands() const {
  RouteMap map = *this;
  map.oncoming_.clear();
  return map;
}

bool RouteMap::is_free(dmrp_vec2 point, double heading) const {
  if (cost(point) >= DMRP_COST_INSCRIBED) return false;
  return robot_.parts.empty() || outline_is_free(point, heading);
}

bool RouteMap::fits(dmrp_vec2 point, double heading) const {
  for (const Oncoming& robot : oncoming_)
    if (distance_to(robot.ahead, point) < robot.need_m || distance_to(robot.left, point) < robot.need_m) return false;
  return is_free(point, heading);
}

double RouteMap::reach_m() const {
  return 0.5 * view_.costmap.width * view_.costmap.resolution_m;
}

// Infinite where the robot does not fit or may not be; around the place that it leaves it fits.
double RouteMap::leg_cost(dmrp_vec2 from, dmrp_vec2 to, const Bounds& bounds) const {
  const double length_m = toolkit::distance(from, to);
  const double heading = toolkit::bearing(from, to);
  const auto steps = std::max(1.0, std::ceil(2.0 * length_m / view_.costmap.resolution_m));
  double sum = 0.0;
  for (double k = 1.0; k <= steps; ++k) {
    const dmrp_vec2 point = toolkit::lerp(from, to, k / steps);
    const bool leaves = bounds.left_place && toolkit::distance(point, *bounds.left_place) < robot_.radius_m;
    const bool may_be_there = !bounds.allowed || bounds.allowed(point);
    if (!may_be_there || (!leaves && !fits(point, heading))) return std::numeric_limits<double>::infinity();
    sum += 1.0 + cost_of_closeness * cost(point) / DMRP_COST_INSCRIBED;
  }
  return length_m * sum / steps;
}

// Leaves out points where the straight leg costs no more than the way.
std::vector<dmrp_vec2> RouteMap::straightened(const std::vector<dmrp_vec2>& way, const Bounds& bounds) const {
  constexpr double rounding = 1e-9;
  std::vector<dmrp_vec2> kept = {way.front()};
  std::size_t last = 0;
  double since = 0.0;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    since += leg_cost(way[i - 1], way[i], bounds);
    if (leg_cost(way[last], way[i + 1], bounds) <= since + leg_cost(way[i], way[i + 1], bounds) + rounding) continue;
    kept.push_back(way[i]);
    last = i;
    since = 0.0;
  }
  kept.push_back(way.back());
  return kept;
}

std::optional<std::vector<dmrp_vec2>> RouteMap::way(dmrp_vec2 from, dmrp_vec2 to,
                                                    const std::function<bool(dmrp_vec2)>& allowed) const {
  const Bounds bounds = {fits(from, view_.pose.theta) ? nullptr : &from, allowed};
  const double step_m = view_.costmap.resolution_m;
  const auto half = static_cast<std::int32_t>(reach_m() / step_m) - 1;
  const std::int32_t side = 2 * half + 1;
  const auto point_of = [&](std::int32_t node) {
    return from + step_m * dmrp_vec2{1.0 * (node % side - half), 1.0 * (node / side - half)};
  };
  struct Open {
    double estimate;
    std::int32_t node;
    bool operator<(const Open& other) const {
      return estimate != other.estimate ? estimate > other.estimate : node > other.node;
    }
  };
  const double none = std::numeric_limits<double>::infinity();
  std::vector<double> costs(static_cast<std::size_t>(side) * side, none);
  std::vector<std::int32_t> parents(costs.size(), -1);
  std::vector<bool> closed(costs.size(), false);
  std::priority_queue<Open> open;
  const std::int32_t start = half * side + half;
  costs[static_cast<std::size_t>(start)] = 0.0;
  open.push({toolkit::distance(from, to), start});
  while (!open.empty()) {
    const std::int32_t node = open.top().node;
    open.pop();
    const auto at = static_cast<std::size_t>(node);
    if (closed[at]) continue;
    closed[at] = true;
    const dmrp_vec2 here = point_of(node);
    if (toolkit::distance(here, to) < step_m) {
      std::vector<dmrp_vec2> points = {to};
      for (std::int32_t n = node; n >= 0; n = parents[static_cast<std::size_t>(n)]) points.push_back(point_of(n));
      std::reverse(points.begin(), points.end());
      return straightened(points, bounds);
    }
    for (std::size_t d = 0; d < 8; ++d) {
      const std::int32_t column = node % side + toolkit::direction_dx[d], row = node / side + toolkit::direction_dy[d];
      if (column < 0 || row < 0 || column >= side || row >= side) continue;
      const std::int32_t next = row * side + column;
      const auto next_at = static_cast<std::size_t>(next);
      if (closed[next_at]) continue;
      const dmrp_vec2 there = point_of(next);
      const double cost = costs[at] + leg_cost(here, there, bounds);
      if (!(cost < costs[next_at])) continue;
      costs[next_at] = cost;
      parents[next_at] = node;
      open.push({cost + toolkit::distance(there, to), next});
    }
  }
  return std::nullopt;
}

}  // namespace dmrp::core
