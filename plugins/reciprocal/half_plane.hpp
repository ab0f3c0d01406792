// SPDX-License-Identifier: MIT
// The velocities that one neighbour or wall permits.
#pragma once

#include <cassert>
#include <dmrp/cpp/plugin_base.hpp>
#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::reciprocal {

// All velocities on a line or to its left.
struct HalfPlane {
  Vec2 point;      // on the line, m/s
  Vec2 direction;  // unit vector along it
};

// The half-plane with `point` on its border and the inward unit vector `normal`.
inline HalfPlane half_plane(Vec2 point, Vec2 normal) {
  assert(toolkit::is_unit(normal));
  return {point, -toolkit::perpendicular(normal)};
}

// The distance of the velocity from the half-plane, m/s; negative inside.
inline double violation(const HalfPlane& plane, Vec2 velocity) {
  return toolkit::cross(plane.direction, plane.point - velocity);
}

}  // namespace dmrp::reciprocal
