// SPDX-License-Identifier: MIT
// surface_distance.hpp: distances between the true outlines of robots, people and static shapes; negative where they
// overlap. Discs are computed as discs.
#pragma once

#include <algorithm>
#include <dmrp/toolkit/polygon.hpp>
#include <dmrp/toolkit/shape_distance.hpp>
#include <limits>
#include <vector>

#include "metrics/measure/bodies.hpp"

namespace dmrp::metrics {

// A body: its disc, or the circle that contains its polygons; and these, in the world frame.
struct Outline {
  Disc disc;
  std::vector<std::vector<Vec2>> parts;  // none: the body is the disc
};

inline Outline outline_of(const Robot& robot, const RobotSample& now) {
  Outline outline = {disc_of(robot, now), {}};
  const dmrp_footprint& footprint = *robot.footprint;
  for (std::uint32_t i = 0; i < footprint.part_count; ++i) {
    const dmrp_polygon& part = *DMRP_AT(dmrp_polygon, footprint.parts, footprint.part_stride, i);
    outline.parts.push_back(toolkit::to_world(now.pose, toolkit::PolygonView(part.vertices, part.vertex_count)));
  }
  return outline;
}

inline Outline outline_of(const Person& person) {
  return {disc_of(person), {}};
}

namespace detail {

// The widest gap between two convex polygons along a normal of the sides of `a`; negative if there is none.
inline double widest_gap(toolkit::PolygonView a, toolkit::PolygonView b) {
  double widest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const dmrp_segment edge = a.edge(i);
    const Vec2 along = toolkit::normalized(edge.to - edge.from);
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2 corner : b) least = std::min(least, toolkit::cross(corner - edge.from, along));
    widest = std::max(widest, least);
  }
  return widest;
}

}  // namespace detail

inline double surface_distance(toolkit::PolygonView a, toolkit::PolygonView b) {
  const double gap = std::max(detail::widest_gap(a, b), detail::widest_gap(b, a));
  if (gap <= 0.0) return gap;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) nearest = std::min(nearest, toolkit::distance(b, a.edge(i)));
  return nearest;
}

inline double surface_distance(const Outline& a, const Outline& b) {
  if (a.parts.empty() && b.parts.empty()) return surface_distance(a.disc, b.disc);
  if (a.parts.empty()) return surface_distance(b, a);
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<Vec2>& part : a.parts) {
    if (b.parts.empty()) nearest = std::min(nearest, toolkit::signed_distance(part, b.disc.center) - b.disc.radius_m);
    for (const std::vector<Vec2>& other : b.parts)
      nearest = std::min(nearest, surface_distance(toolkit::PolygonView(part), toolkit::PolygonView(other)));
  }
  return nearest;
}

// From a body made of polygons to the nearest static shape, or to the border of the world.
inline double distance_to_walls(const Outline& body, const World& world) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<Vec2>& part : body.parts)
    for (const Vec2 corner : part)
      nearest = std::min({nearest, corner.x - world->lower.x, corner.y - world->lower.y, world->upper.x - corner.x,
                          world->upper.y - corner.y});
  for (const Shape& shape : world.shapes()) {
    if (toolkit::distance(toolkit::bounds(shape), body.disc.center) - body.disc.radius_m > nearest) continue;
    Outline wall = {{shape.center, shape.radius_m}, {}};
    if (shape.kind == DMRP_SHAPE_POLYGON) {
      const toolkit::PolygonView polygon = toolkit::polygon_of(shape);
      wall.parts.emplace_back(polygon.begin(), polygon.end());
    }
    nearest = std::min(nearest, surface_distance(body, wall));
  }
  return nearest;
}

// The least surface distance from a body to others added one by one. Looks closer only at those whose circles are near.
class NearestBody {
 public:
  explicit NearestBody(const Outline& own) : own_(own) {}
  void add(const Outline& other) {
    const double reach_m = distance_m_ + own_.disc.radius_m + other.disc.radius_m;
    const double squared_distance = toolkit::squared_distance(own_.disc.center, other.disc.center);
    if (reach_m > 0.0 && squared_distance < reach_m * reach_m)
      distance_m_ = std::min(distance_m_, surface_distance(own_, other));
  }

  // NaN if no body was added.
  double distance_m() const { return std::isinf(distance_m_) ? undefined : distance_m_; }

 private:
  const Outline& own_;
  double distance_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace dmrp::metrics
