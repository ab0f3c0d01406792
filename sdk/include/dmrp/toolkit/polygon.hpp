// SPDX-License-Identifier: MIT
// polygon.hpp: convex polygons, metres. Vertices counter-clockwise; the border belongs to the polygon. All functions
// but signed_area() require a convex counter-clockwise polygon (is_convex_ccw) and give meaningless results otherwise.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "angle.hpp"
#include "segment.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

// A view of vertices owned by a vector, an array or a dmrp_shape.
class PolygonView {
 public:
  PolygonView(const dmrp_vec2* vertices, std::size_t count) : vertices_(vertices), count_(count) {}
  template <class Vertices, class = std::enable_if_t<std::is_convertible_v<
                                decltype(std::declval<const Vertices&>().data()), const dmrp_vec2*>>>
  PolygonView(const Vertices& vertices) : PolygonView(vertices.data(), vertices.size()) {}

  std::size_t size() const { return count_; }
  const dmrp_vec2& operator[](std::size_t i) const { return vertices_[i]; }
  const dmrp_vec2* begin() const { return vertices_; }
  const dmrp_vec2* end() const { return vertices_ + count_; }

  // The edge from vertex i to the next.
  dmrp_segment edge(std::size_t i) const { return {vertices_[i], vertices_[i + 1 < count_ ? i + 1 : 0]}; }

 private:
  const dmrp_vec2* vertices_;
  std::size_t count_;
};

// m^2, positive if the vertices run counter-clockwise; for any polygon that does not cross itself.
inline double signed_area(PolygonView polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) twice += orientation(polygon[0], polygon[i], polygon[i + 1]);
  return 0.5 * twice;
}

// Whether at least three vertices run once around a convex area, counter-clockwise, without repeating one in a row.
// Vertices along a straight side are accepted, within a nanometre.
inline bool is_convex_ccw(PolygonView polygon) {
  if (polygon.size() < 3 || !(signed_area(polygon) > 0.0)) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_segment edge = polygon.edge(i);
    if (edge.from == edge.to) return false;
    const double nanometre = -1e-9 * length(edge);
    for (const dmrp_vec2 vertex : polygon)
      if (!(orientation(edge.from, edge.to, vertex) >= nanometre)) return false;
  }
  return true;
}

inline bool contains(PolygonView polygon, dmrp_vec2 point) {
  assert(polygon.size() >= 3);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_segment edge = polygon.edge(i);
    if (orientation(edge.from, edge.to, point) < 0.0) return false;
  }
  return true;
}

// The point of the border nearest to `point`, which may lie inside; among equals the one on the first edge.
inline dmrp_vec2 closest_border_point(PolygonView polygon, dmrp_vec2 point) {
  assert(polygon.size() >= 3);
  dmrp_vec2 best = polygon[0];
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_vec2 candidate = closest_point(polygon.edge(i), point);
    const double candidate_distance = squared_distance(candidate, point);
    if (candidate_distance < best_distance) {
      best = candidate;
      best_distance = candidate_distance;
    }
  }
  return best;
}

// The nearest point of the polygon: `point` itself if it lies inside.
inline dmrp_vec2 closest_point(PolygonView polygon, dmrp_vec2 point) {
  return contains(polygon, point) ? point : closest_border_point(polygon, point);
}

// Distance to the border, negative inside.
inline double signed_distance(PolygonView polygon, dmrp_vec2 point) {
  const double to_border = distance(closest_border_point(polygon, point), point);
  return contains(polygon, point) ? -to_border : to_border;
}

// 0 inside.
inline double distance(PolygonView polygon, dmrp_vec2 point) {
  return distance(closest_point(polygon, point), point);
}

// 0 if they touch or the segment lies inside.
inline double distance(PolygonView polygon, const dmrp_segment& segment) {
  if (contains(polygon, segment.from)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) nearest = std::min(nearest, distance(polygon.edge(i), segment));
  return nearest;
}

// `count` >= 3 vertices on the circle, the first at angle 0: a polygon inside the circle, whose sides lie at most
// radius_m * (1 - cos(pi / count)) inside it.
inline std::vector<dmrp_vec2> polygon_of_circle(dmrp_vec2 center, double radius_m, std::size_t count) {
  assert(count >= 3);
  std::vector<dmrp_vec2> vertices(count);
  for (std::size_t i = 0; i < count; ++i)
    vertices[i] = center + radius_m * from_angle(2.0 * pi * static_cast<double>(i) / static_cast<double>(count));
  return vertices;
}

// The vertices of a polygon given in a frame, in world coordinates; for example a footprint at a pose.
inline std::vector<dmrp_vec2> to_world(const dmrp_pose& frame, PolygonView local) {
  std::vector<dmrp_vec2> vertices;
  vertices.reserve(local.size());
  for (const dmrp_vec2 vertex : local) vertices.push_back(to_world(frame, vertex));
  return vertices;
}

}  // namespace dmrp::toolkit
