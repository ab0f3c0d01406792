// SPDX-License-Identifier: MIT
// shape_distance.hpp: distances to the static shapes of a world, metres.
#pragma once

#include <algorithm>

#include "../world.h"
#include "polygon.hpp"
#include "rectangle.hpp"
#include "segment.hpp"

namespace dmrp::toolkit {

// The vertices of a shape of kind DMRP_SHAPE_POLYGON.
inline PolygonView polygon_of(const dmrp_shape& shape) {
  return {shape.vertices, shape.vertex_count};
}

// The axis-aligned bounding box of a polygon or a shape.
inline Rectangle bounds(PolygonView polygon) {
  Rectangle box = {polygon[0], polygon[0]};
  for (const dmrp_vec2 vertex : polygon) {
    box.lower = {std::min(box.lower.x, vertex.x), std::min(box.lower.y, vertex.y)};
    box.upper = {std::max(box.upper.x, vertex.x), std::max(box.upper.y, vertex.y)};
  }
  return box;
}
inline Rectangle bounds(const dmrp_shape& shape) {
  if (shape.kind != DMRP_SHAPE_CIRCLE) return bounds(polygon_of(shape));
  const dmrp_vec2 reach = {shape.radius_m, shape.radius_m};
  return {shape.center - reach, shape.center + reach};
}

// To the shape's outline, negative inside.
inline double signed_distance(const dmrp_shape& shape, dmrp_vec2 point) {
  if (shape.kind == DMRP_SHAPE_CIRCLE) return distance(shape.center, point) - shape.radius_m;
  return signed_distance(polygon_of(shape), point);
}

// 0 inside.
inline double distance(const dmrp_shape& shape, dmrp_vec2 point) {
  if (shape.kind == DMRP_SHAPE_CIRCLE) return std::max(0.0, distance(shape.center, point) - shape.radius_m);
  return distance(polygon_of(shape), point);
}

// 0 if they touch or the segment lies inside.
inline double distance(const dmrp_shape& shape, const dmrp_segment& segment) {
  if (shape.kind == DMRP_SHAPE_CIRCLE) return std::max(0.0, distance(segment, shape.center) - shape.radius_m);
  return distance(polygon_of(shape), segment);
}

// The distance from a point to the nearest shape or to the border of the world; 0 inside a shape or outside the border.
// `shapes` is any range of dmrp_shape.
template <class Shapes>
double clearance(const Shapes& shapes, const Rectangle& border, dmrp_vec2 point) {
  double nearest = std::max(0.0, depth(border, point));
  for (const dmrp_shape& shape : shapes) {
    if (distance(bounds(shape), point) < nearest) nearest = std::min(nearest, distance(shape, point));
  }
  return nearest;
}

}  // namespace dmrp::toolkit
