// SPDX-License-Identifier: MIT
// ray_cast.hpp: the distance at which a ray hits a body, metres.
//
// A ray is an origin and a unit direction. Every function returns the distance to the first common point; 0 if the
// origin lies in the body; infinity if the ray misses. Touching counts as a hit, within the precision of doubles.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "../world.h"
#include "polygon.hpp"
#include "rectangle.hpp"
#include "shape_distance.hpp"
#include "vec2.hpp"

namespace dmrp::toolkit {

struct Ray {
  dmrp_vec2 origin = {0.0, 0.0};
  dmrp_vec2 direction = {1.0, 0.0};  // of length 1
};

DMRP_LOCAL inline constexpr double ray_misses = std::numeric_limits<double>::infinity();

inline double ray_to_circle(const Ray& ray, dmrp_vec2 center, double radius_m) {
  assert(is_unit(ray.direction));
  const dmrp_vec2 to_center = center - ray.origin;
  if (squared_norm(to_center) <= radius_m * radius_m) return 0.0;
  const double along = dot(to_center, ray.direction);
  const double aside = cross(ray.direction, to_center);
  const double squared_half_chord = radius_m * radius_m - aside * aside;
  if (along < 0.0 || squared_half_chord < 0.0) return ray_misses;
  return std::max(0.0, along - std::sqrt(squared_half_chord));
}

// The ray hits a segment on its own line at the segment's nearer end.
inline double ray_to_segment(const Ray& ray, const dmrp_segment& segment) {
  assert(is_unit(ray.direction));
  const dmrp_vec2 to_from = segment.from - ray.origin;
  const dmrp_vec2 to_to = segment.to - ray.origin;
  const double from_side = cross(ray.direction, to_from);
  const double to_side = cross(ray.direction, to_to);
  if (from_side == 0.0 && to_side == 0.0) {
    const double near_end = std::min(dot(to_from, ray.direction), dot(to_to, ray.direction));
    const double far_end = std::max(dot(to_from, ray.direction), dot(to_to, ray.direction));
    return far_end < 0.0 ? ray_misses : std::max(0.0, near_end);
  }
  if ((from_side > 0.0 && to_side > 0.0) || (from_side < 0.0 && to_side < 0.0)) return ray_misses;
  // The ends lie on opposite sides of the ray's line, which crosses the segment at this fraction.
  const double fraction = from_side / (from_side - to_side);
  const double along = dot(lerp(to_from, to_to, fraction), ray.direction);
  return along < 0.0 ? ray_misses : along;
}

// Convex, counter-clockwise: the ray clipped by the half-planes of all edges (Cyrus and Beck 1978).
inline double ray_to_polygon(const Ray& ray, PolygonView polygon) {
  assert(is_unit(ray.direction) && polygon.size() >= 3);
  double enter = 0.0;
  double leave = ray_misses;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dmrp_segment edge = polygon.edge(i);
    const dmrp_vec2 along = edge.to - edge.from;
    const double inside = cross(along, ray.origin - edge.from);  // >= 0 on the inner side
    const double approach = cross(along, ray.direction);
    if (approach == 0.0) {
      if (inside < 0.0) return ray_misses;
    } else if (approach > 0.0) {
      enter = std::max(enter, -inside / approach);
    } else {
      leave = std::min(leave, -inside / approach);
    }
  }
  return enter <= leave ? enter : ray_misses;
}

inline double ray_to_shape(const Ray& ray, const dmrp_shape& shape) {
  if (shape.kind == DMRP_SHAPE_CIRCLE) return ray_to_circle(ray, shape.center, shape.radius_m);
  return ray_to_polygon(ray, polygon_of(shape));
}

// From inside a rectangle to its border; 0 from outside.
inline double ray_to_border(const Ray& ray, const Rectangle& border) {
  if (!contains(border, ray.origin)) return 0.0;
  const auto reach = [](double origin, double direction, double lower, double upper) {
    if (direction == 0.0) return ray_misses;
    return ((direction > 0.0 ? upper : lower) - origin) / direction;
  };
  return std::min(reach(ray.origin.x, ray.direction.x, border.lower.x, border.upper.x),
                  reach(ray.origin.y, ray.direction.y, border.lower.y, border.upper.y));
}

}  // namespace dmrp::toolkit
