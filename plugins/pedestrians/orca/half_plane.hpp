// SPDX-License-Identifier: MIT
// Velocities that somebody permits themselves on account of one other body or wall.
#pragma once

#include <dmrp/values.h>

#include <dmrp/toolkit/vec2.hpp>

namespace dmrp::pedestrians {

// All velocities on or to the left of a line.
struct HalfPlane {
  dmrp_vec2 point;      // on the line, m/s
  dmrp_vec2 direction;  // unit vector along it
};

// The half-plane whose border goes through `point` and that lies where the unit vector `normal` points.
inline HalfPlane half_plane(dmrp_vec2 point, dmrp_vec2 normal) {
  return {point, -toolkit::perpendicular(normal)};
}

// How far outside the half-plane the velocity lies, m/s; negative inside.
inline double violation(const HalfPlane& plane, dmrp_vec2 velocity) {
  return toolkit::cross(plane.direction, plane.point - velocity);
}

}  // namespace dmrp::pedestrians
