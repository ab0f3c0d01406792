// SPDX-License-Identifier: MIT
#include "core/scene/convex_separation.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <dmrp/toolkit/segment.hpp>
#include <dmrp/toolkit/vec2.hpp>
#include <limits>

#include "core/scene/touching.hpp"

namespace dmrp::core {
namespace {

dmrp_vec2 outward_normal(const dmrp_segment& edge) {
  return -toolkit::perpendicular(toolkit::normalized(edge.to - edge.from));
}

// The edge of `a` from whose line `b` is farthest; the normal points out of `a`.
Separation best_axis(toolkit::PolygonView a, toolkit::PolygonView b) {
  Separation best = {-std::numeric_limits<double>::infinity(), {}};
  for (std::size_t i = 0; i < a.size(); ++i) {
    const dmrp_segment edge = a.edge(i);
    const dmrp_vec2 normal = outward_normal(edge);
    const double distance_m = -extent(b, edge.from, -normal);
    if (distance_m > best.distance_m) best = {distance_m, normal};
  }
  return best;
}

// The shortest vector from a corner of `corners` to `polygon`, of those shorter than `best`.
void take_shorter(toolkit::PolygonView corners, toolkit::PolygonView polygon, double sign, dmrp_vec2& best) {
  for (const dmrp_vec2 corner : corners) {
    const dmrp_vec2 way = sign * (toolkit::closest_border_point(polygon, corner) - corner);
    if (toolkit::squared_norm(way) < toolkit::squared_norm(best)) best = way;
  }
}

// The part of the polygon on the left of the edge's line.
ConvexPolygon left_of(const dmrp_segment& edge, const ConvexPolygon& polygon) {
  ConvexPolygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_vec2 from = polygon[i];
    const dmrp_vec2 to = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const double from_side = toolkit::orientation(edge.from, edge.to, from);
    const double to_side = toolkit::orientation(edge.from, edge.to, to);
    if (from_side >= 0.0) kept.push_back(from);
    if ((from_side > 0.0 && to_side < 0.0) || (from_side < 0.0 && to_side > 0.0))
      kept.push_back(from + (to - from) * (from_side / (from_side - to_side)));
  }
  return kept;
}

}  // namespace

double extent(toolkit::PolygonView polygon, dmrp_vec2 from, dmrp_vec2 direction) {
  double farthest_m = -std::numeric_limits<double>::infinity();
  for (const dmrp_vec2 vertex : polygon) farthest_m = std::max(farthest_m, toolkit::dot(vertex - from, direction));
  return farthest_m;
}

Separation separation(toolkit::PolygonView a, toolkit::PolygonView b) {
  assert(a.size() >= 3 && b.size() >= 3);
  const Separation of_a = best_axis(a, b);
  const Separation of_b = best_axis(b, a);
  // the normals of b's edges already point from b toward a
  const Separation axis = of_b.distance_m >= of_a.distance_m ? of_b : Separation{of_a.distance_m, -of_a.normal};
  if (axis.distance_m <= touching_m) return axis;
  dmrp_vec2 from_b{std::numeric_limits<double>::max(), 0.0};
  take_shorter(a, b, -1.0, from_b);
  take_shorter(b, a, 1.0, from_b);
  const double distance_m = toolkit::norm(from_b);
  return {distance_m, from_b / distance_m};
}

Separation separation(toolkit::PolygonView a, dmrp_vec2 center, double radius_m) {
  assert(a.size() >= 3 && radius_m >= 0.0);
  const dmrp_vec2 from_center = toolkit::closest_border_point(a, center) - center;
  const double distance_m = toolkit::norm(from_center);
  const bool inside = toolkit::contains(a, center);
  if (distance_m > touching_m)
    return {(inside ? -distance_m : distance_m) - radius_m, (inside ? -1.0 : 1.0) / distance_m * from_center};
  // the centre lies on the outline: the normal of the nearest edge, from the centre into the polygon
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < a.size(); ++i)
    if (toolkit::distance(a.edge(i), center) < toolkit::distance(a.edge(nearest), center)) nearest = i;
  return {-radius_m, -outward_normal(a.edge(nearest))};
}

dmrp_vec2 middle_of_overlap(toolkit::PolygonView a, toolkit::PolygonView b) {
  ConvexPolygon common(a.begin(), a.end());
  for (std::size_t i = 0; i < b.size(); ++i) common = left_of(b.edge(i), common);
  assert(!common.empty());
  dmrp_vec2 sum{};
  for (const dmrp_vec2 corner : common) sum += corner;
  return sum / static_cast<double>(common.size());
}

}  // namespace dmrp::core
