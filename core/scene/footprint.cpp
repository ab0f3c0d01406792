// SPDX-License-Identifier: MIT
#include "core/scene/footprint.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <dmrp/toolkit/polygon.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

constexpr dmrp_vec2 origin = {0.0, 0.0};

// The stretch of the edge that lies inside the polygon, as shares of its length; empty (first > second) if none. An
// edge along the polygon's border counts as inside if the two bodies lie on different sides of it: there the union has
// no outline. If they lie on the same side, the outline runs along both edges, so neither may hide the other.
std::pair<double, double> stretch_inside(const dmrp_segment& edge, toolkit::PolygonView polygon) {
  const dmrp_vec2 along = edge.to - edge.from;
  double enter = 0.0;
  double leave = 1.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_segment side = polygon.edge(i);
    const dmrp_vec2 direction = toolkit::normalized(side.to - side.from);
    const double depth_m = toolkit::cross(direction, edge.from - side.from);
    const double gain_m = toolkit::cross(direction, along);
    if (std::abs(gain_m) <= touching_m) {
      const bool on_side = std::abs(depth_m) <= touching_m;
      if (depth_m < -touching_m || (on_side && toolkit::dot(direction, along) > 0.0)) return {1.0, 0.0};
    } else if (gain_m > 0.0) {
      enter = std::max(enter, -depth_m / gain_m);
    } else {
      leave = std::min(leave, -depth_m / gain_m);
    }
  }
  return {enter, leave};
}

// The distance from the origin to what the other parts leave of an edge.
double distance_to_outline(std::span<const ConvexPolygon> parts, std::size_t part, const dmrp_segment& edge) {
  std::vector<std::pair<double, double>> hidden;
  for (std::size_t other = 0; other < parts.size(); ++other)
    if (other != part) hidden.push_back(stretch_inside(edge, parts[other]));
  std::sort(hidden.begin(), hidden.end());
  const dmrp_vec2 along = edge.to - edge.from;
  double nearest_m = std::numeric_limits<double>::infinity();
  double seen_from = 0.0;
  const auto see_up_to = [&](double share) {
    if ((share - seen_from) * toolkit::norm(along) <= touching_m) return;
    const dmrp_segment seen = {edge.from + along * seen_from, edge.from + along * share};
    nearest_m = std::min(nearest_m, toolkit::distance(seen, origin));
  };
  for (const auto& [enter, leave] : hidden) {
    if (enter > leave) continue;
    see_up_to(enter);
    seen_from = std::max(seen_from, leave);
  }
  see_up_to(1.0);
  return nearest_m;
}

}  // namespace

double circumscribed_radius(std::span<const ConvexPolygon> parts) {
  double radius_m = 0.0;
  for (const ConvexPolygon& part : parts)
    for (const dmrp_vec2 vertex : part) radius_m = std::max(radius_m, toolkit::norm(vertex));
  return radius_m;
}

double inscribed_radius(std::span<const ConvexPolygon> parts) {
  if (std::none_of(parts.begin(), parts.end(), [](const auto& part) { return toolkit::contains(part, origin); }))
    return 0.0;
  double radius_m = std::numeric_limits<double>::infinity();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const toolkit::PolygonView polygon(parts[part]);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      radius_m = std::min(radius_m, distance_to_outline(parts, part, polygon.edge(i)));
  }
  return radius_m;
}

double inscribed_radius(const RobotSettings& robot) {
  return robot.parts.empty() ? robot.radius_m : inscribed_radius(robot.parts);
}

ConvexPolygon swept(const ConvexPolygon& polygon, dmrp_vec2 way) {
  assert(polygon.size() >= 3);
  ConvexPolygon area;
  const auto leads = [&](std::size_t edge) {
    const dmrp_segment side = toolkit::PolygonView(polygon).edge(edge);
    return toolkit::cross(way, side.to - side.from) > 0.0;  // its outward normal points ahead
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const bool before = leads((i + polygon.size() - 1) % polygon.size());
    const bool after = leads(i);
    if (before) area.push_back(polygon[i] + way);
    if (before != after || !before) area.push_back(polygon[i]);
    if (!before && after) area.push_back(polygon[i] + way);
  }
  return area;
}

}  // namespace dmrp::core
