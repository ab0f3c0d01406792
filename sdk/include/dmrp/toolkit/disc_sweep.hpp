// SPDX-License-Identifier: MIT
// disc_sweep.hpp: whether a disc may move straight from one place to another among static shapes.
//
// Exact, not sampled: a disc swept along a segment stays clear of a shape if the segment is at least the disc's radius
// away from it. Touching counts as clear. `shapes` is any range of dmrp_shape; metres.
#pragma once

#include <algorithm>

#include "rectangle.hpp"
#include "segment.hpp"
#include "shape_distance.hpp"

namespace dmrp::toolkit {

// Whether a disc of this radius, swept along `motion`, stays clear of every shape and inside `border`.
template <class Shapes>
bool disc_sweep_is_clear(const dmrp_segment& motion, double radius_m, const Shapes& shapes, const Rectangle& border) {
  // The border is convex: it contains the motion if it contains both ends.
  if (depth(border, motion.from) < radius_m || depth(border, motion.to) < radius_m) return false;
  const Rectangle reach = {
      {std::min(motion.from.x, motion.to.x) - radius_m, std::min(motion.from.y, motion.to.y) - radius_m},
      {std::max(motion.from.x, motion.to.x) + radius_m, std::max(motion.from.y, motion.to.y) + radius_m}};
  for (const dmrp_shape& shape : shapes) {
    const Rectangle box = bounds(shape);
    const bool apart = box.lower.x > reach.upper.x || box.upper.x < reach.lower.x || box.lower.y > reach.upper.y ||
                       box.upper.y < reach.lower.y;
    if (!apart && distance(shape, motion) < radius_m) return false;
  }
  return true;
}

// The same for a disc that may start too close to a shape, as a robot does after a contact: it must not come closer
// than it starts.
template <class Shapes>
bool disc_retreat_is_clear(const dmrp_segment& motion, double radius_m, const Shapes& shapes, const Rectangle& border) {
  const double nanometre = 1e-9;  // more than the rounding of either distance
  const double kept_m = std::min(radius_m, clearance(shapes, border, motion.from) - nanometre);
  return disc_sweep_is_clear(motion, kept_m, shapes, border);
}

}  // namespace dmrp::toolkit
